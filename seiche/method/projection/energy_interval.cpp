#include <seiche/core/base/vector.hpp>
#include <seiche/method/projection/energy_interval.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seiche {

namespace {

constexpr double margin = 8;         // for what the nonlinear part does where the linear one is not resolved
constexpr double noticeable = 1e-3;  // a share of the dissipation

// x/(1 − x): the share of the dissipation by which it may be wrong where damping acts so far in one step.
double excess_of_strong(double damped) {
  constexpr double strong = 0.07;
  const double share = damped / strong, x = square(share * share * share);
  return x < 1 ? x / (1 - x) : std::numeric_limits<double>::infinity();
}

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
                           FunctionRef<double()> damped, FunctionRef<double()> flow_missed) {
  if (law == EnergyLaw::none) return {computed, std::numeric_limits<double>::infinity()};
  if (kind == StepDissipation::Kind::none) return {before, before};
  if (law == EnergyLaw::guard) {
    if (dissipated.negative) return {computed, std::max(before, computed)};
    return {std::min(computed, before), before};
  }
  const double u = dissipated.doubt;
  const double narrow = nearest(before, computed, rest, dissipated, u);  // E*: (E4)
  double target = narrow;
  bool strong = false, widened = false;
  if (narrow != computed) {
    const double by_damping = std::abs(dissipated.fine + dissipated.work);
    double wide = std::numeric_limits<double>::infinity();
    const double excess = excess_of_strong(damped());
    strong = !std::isfinite(excess);
    if (!strong) wide = u + by_damping * excess + margin * std::abs(flow_missed());
    target = nearest(before, computed, rest, dissipated, wide);
    // Errors of a scheme that resolves the flow, and round-off, are less than this.
    const double round_off = 16 * epsilon * (std::abs(before) + std::abs(computed));
    widened = std::abs(target - narrow) > u + noticeable * by_damping + round_off;
  }
  return {target, dissipated.negative ? std::max(before, target) : before, strong, widened};
}

}  // namespace seiche
