#include <seiche/core/vector.hpp>
#include <seiche/method/projection/energy_interval.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seiche {

namespace {

constexpr double margin = 8;  // for what the nonlinear part does where the linear one is not resolved

// The value of the interval of half width u about Hⁿ − D that is nearest to Ĥ.
double nearest(double before, double computed, double rest, const StepDissipation::Amount& dissipated, double u) {
  const double lower = before - dissipated.fine - u;
  const double upper = before - dissipated.fine + u;
  if (dissipated.negative) return std::clamp(computed, lower, upper);
  // An upper end below H(0) cannot be reached by shrinking z: the quadrature means nothing.
  const bool meaningless = !std::isfinite(u) || (upper <= rest && rest < before);
  if (meaningless) return std::min(computed, before);
  return std::clamp(computed, std::min(lower, before), std::min(upper, before));
}

}  // namespace

EnergyTarget energy_target(EnergyLaw law, double before, double computed, double rest,
                           const StepDissipation::Amount& dissipated, StepDissipation::Kind kind,
                           FunctionRef<double()> flow_missed) {
  if (law == EnergyLaw::none) return {computed, std::numeric_limits<double>::infinity()};
  if (kind == StepDissipation::Kind::none) return {before, before};
  if (law == EnergyLaw::guard) {
    if (dissipated.negative) return {computed, std::max(before, computed)};
    return {std::min(computed, before), before};
  }
  const double u = dissipated.doubt;
  const double narrow = nearest(before, computed, rest, dissipated, u);  // E*: (E4)
  double target = narrow;
  bool widened = false;
  if (narrow != computed) {
    if (const double missed = std::abs(flow_missed()); missed > 0) {
      target = nearest(before, computed, rest, dissipated, u + margin * missed);
      // Where steps resolve the flow, what the quadrature misses of it is far less than what the two differ by.
      widened = std::abs(target - narrow) > u + 16 * epsilon * (std::abs(before) + std::abs(computed));
    }
  }
  return {target, dissipated.negative ? std::max(before, target) : before, widened};
}

}  // namespace seiche
