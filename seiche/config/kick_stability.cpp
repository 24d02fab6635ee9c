#include <seiche/config/auto_method.hpp>
#include <seiche/config/kick_stability.hpp>
#include <seiche/method/nystrom_scheme.hpp>

#include <fmt/format.h>

namespace seiche {

std::string beyond_stability(const Simulation& simulation, double h) {
  const MethodEntry& method = simulation.method();
  if (simulation.method_options().linear != LinearTreatment::explicit_kicks) return "";
  const double fastest = rates_of(simulation.system()).linear;
  const double largest = stability_of_kicks(nystrom_scheme(method.order)) / fastest;
  if (!(h > largest)) return "";
  return fmt::format(
      "h = {:.4g} is beyond the stability of {} with linear = \"explicit\": the linear part has rates up to {:.4g}, and kicks need h "
      "≤ {:.3g} there; take a smaller h, or linear = \"exact\"",
      h, method.name, fastest, largest);
}

}  // namespace seiche
