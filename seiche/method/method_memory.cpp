#include <seiche/core/step_cache.hpp>
#include <seiche/method/collocation/collocation_equations.hpp>
#include <seiche/method/method_memory.hpp>

namespace seiche {

double doubles_of_collocation(int order, Index size, bool variable_steps, double slots) {
  const double s = 0.5 * order;
  const double blocks = s * (2 + s) + 2 * (2 + s) + (2 + s) * (3 + s) + 4;  // per mode, of two fields
  const double of_extension = 4 * 4 * s;                                    // four ratios of step sizes, two maps each
  const double step_sizes = variable_steps ? static_cast<double>(cached_step_sizes(size)) : 1.0;
  return 2 * s + 14 + step_sizes * (blocks + (variable_steps ? of_extension : 0)) / (2 * slots);
}

double doubles_of_acceleration(int order) {
  constexpr int of_pairs = 2 * CollocationEquations::memory, of_iterates = 4, of_samples = 2;
  return 0.5 * order * (of_pairs + of_iterates + of_samples);
}

double doubles_of_one_step(int order, Index size, bool variable_steps, double slots) {
  const double s = order;
  const double blocks = 2 * (2 + 0.5 * s) * s + 2 * (2 + s) + (2 + s) * (3 + s) + 4;
  const double step_sizes = variable_steps ? static_cast<double>(cached_step_sizes(size)) : 1.0;
  return s + 16 + (variable_steps ? 10 : 0) + step_sizes * blocks / (2 * slots);
}

}  // namespace seiche
