#include <seiche/core/step_cache.hpp>
#include <seiche/method/collocation/collocation_equations.hpp>
#include <seiche/method/method_memory.hpp>

namespace seiche {
namespace {

double one_step(int order, bool variable_steps, double tables) {
  const double s = order;
  const double blocks = 2 * (2 + 0.5 * s) * s + 2 * (2 + s) + (2 + s) * (3 + s) + 4;
  return s + 16 + (variable_steps ? 10 : 0) + tables * blocks;
}

}  // namespace

double step_sizes(Index size, bool variable_steps) {
  return variable_steps ? static_cast<double>(cached_step_sizes(size)) : 1.0;
}

double doubles_of_estimate(Index size, double per_mode) { return 19 + 43 * step_sizes(size, true) / per_mode; }

double doubles_of_collocation(int order, Index size, bool variable_steps, double per_mode) {
  const double s = 0.5 * order;
  const double blocks = s * (2 + s) + 2 * (2 + s) + (2 + s) * (3 + s) + 4;  // per mode, of two fields
  const double of_extension = variable_steps ? 4 * 4 * s : 0;               // four ratios of step sizes, two maps each
  return 2 * s + 34 + step_sizes(size, variable_steps) * (blocks + of_extension) / per_mode;
}

double doubles_of_acceleration(int order) {
  constexpr int of_pairs = 2 * CollocationEquations::memory, of_iterates = 4, of_samples = 2;
  return 0.5 * order * (of_pairs + of_iterates + of_samples);
}

double doubles_of_splitting(int order, Index size, bool variable_steps, double per_mode) {
  return one_step(order, variable_steps, step_sizes(size, variable_steps) / per_mode);
}

double doubles_of_runge_kutta(int order, Index size, bool variable_steps, double per_mode) {
  return one_step(order, variable_steps, (variable_steps ? 2 : 1) * step_sizes(size, variable_steps) / per_mode);
}

double doubles_of_kicks(int order, Index size, bool variable_steps, double per_mode) {
  return 20 + (variable_steps ? 40 : 0) + step_sizes(size, variable_steps) * (18 + 4.5 * order) / per_mode;
}

}  // namespace seiche
