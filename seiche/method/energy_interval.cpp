#include <seiche/method/energy_interval.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seiche {

EnergyTarget energy_target(EnergyLaw law, double before, double computed, double rest,
                           const StepDissipation::Amount& dissipated, StepDissipation::Kind kind) {
  if (law == EnergyLaw::none) return {computed, std::numeric_limits<double>::infinity()};
  if (kind == StepDissipation::Kind::none) return {before, before};
  if (law == EnergyLaw::guard) {
    if (dissipated.negative) return {computed, std::max(before, computed)};
    return {std::min(computed, before), before};
  }
  const double u = std::abs(dissipated.fine - dissipated.coarse);
  const double lower = before - dissipated.fine - u;
  const double upper = before - dissipated.fine + u;
  if (dissipated.negative) {
    const double target = std::clamp(computed, lower, upper);
    return {target, std::max(before, target)};
  }
  // An upper end below H(0) cannot be reached by shrinking z: the quadrature means nothing.
  const bool meaningless = !std::isfinite(u) || (upper <= rest && rest < before);
  if (meaningless) return {std::min(computed, before), before};
  return {std::clamp(computed, std::min(lower, before), std::min(upper, before)), before};
}

}  // namespace seiche
