#include <seiche/config/auto_method.hpp>
#include <seiche/config/kick_stability.hpp>
#include <seiche/method/nystrom_scheme.hpp>

#include <fmt/format.h>

#include <cmath>

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

std::string beyond_rate(const Simulation& simulation, double h, double t_end) {
  constexpr int samples = 4096;
  const Composition composition = simulation.method().composition;
  const RatePointer& rate = simulation.problem().damping.rate;
  const bool holds_rate_of_start = composition == Composition::collocation || composition == Composition::runge_kutta;
  if (!holds_rate_of_start || !rate || rate->is_constant()) return "";
  const double held = frozen_rate(simulation.problem());
  double farthest = held;
  for (int i = 0; i <= samples; ++i) {
    const double gamma = rate->value(t_end * i / samples);
    if (std::abs(gamma - held) > std::abs(farthest - held)) farthest = gamma;
  }
  if (!(h * std::abs(farthest - held) > 1)) return "";
  return fmt::format(
      "the rate {} reaches {:.3g}, and the exponential of {} holds the {:.3g} of the start: for what changes h ≤ {:.2g} is needed; or take "
      "a splitting such as seisav, which takes the integral of the rate, or a tolerance",
      rate->text(), farthest, simulation.method().name, held, 1 / std::abs(farthest - held));
}

}  // namespace seiche
