#include <test/support/convergence.hpp>
#include <test/support/worst.hpp>

#include <fmt/format.h>

#include <cmath>

namespace seiche::test {

Errors errors_against(const Reference& reference, const Problem& problem, const SimulationOptions& options, double h) {
  Simulation simulation(problem, options);
  const double t_end = reference.time(reference.count() - 1);
  const auto steps = static_cast<long long>(std::llround(t_end / h));
  Errors errors;
  for (long long n = 1; n <= steps; ++n) {
    simulation.state().t = static_cast<double>(n - 1) * h;
    const StepReport report = simulation.step(h);
    errors.unresolved += report.unresolved;
    if (!report.solved()) {
      errors.failure = report.message;
      return errors;
    }
    const std::size_t k = reference.index_of(static_cast<double>(n) * h);
    const std::span<const double> exact = reference.state(k);
    const Vector distance =
        simulation.physical() - Eigen::Map<const Vector>(exact.data(), static_cast<Index>(exact.size()));
    errors.solution = worse(errors.solution, largest(distance));
    errors.energy =
        worse(errors.energy, std::abs(simulation.system().energy(simulation.state().z) - reference.energy(k)));
  }
  return errors;
}

double fitted_order(const std::vector<double>& h, const std::vector<double>& error) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < h.size(); ++i) {
    if (error[i] < 1e-13) continue;
    const double x = std::log(h[i]);
    const double y = std::log(error[i]);
    n += 1;
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return n < 3 ? std::nan("") : (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

std::string table(const std::vector<double>& h, const std::vector<double>& error) {
  std::string text;
  for (std::size_t i = 0; i < h.size(); ++i) text += fmt::format("  h = {:<12} error = {:.4e}\n", h[i], error[i]);
  return text;
}

}  // namespace seiche::test
