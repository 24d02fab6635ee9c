#include <seiche/config/run_memory.hpp>
#include <seiche/core/step_cache.hpp>

namespace seiche {
namespace {

// Collocation in doubles per unknown: two forces a stage and some vectors, and for each step size that is kept the blocks of
// stages, end and forms; with variable steps also those of the extension.
double doubles_of_collocation(int order, Index size, bool variable_steps) {
  const double s = 0.5 * order;
  const double blocks = s * (2 + s) + 2 * (2 + s) + (2 + s) * (3 + s) + 4;  // per mode, of two slots and two fields
  const double of_extension = 4 * 4 * s;                                    // four ratios of step sizes, two maps each
  const double step_sizes = variable_steps ? static_cast<double>(cached_step_sizes(size)) : 1.0;
  return 2 * s + 14 + step_sizes * (blocks + (variable_steps ? of_extension : 0)) / 4;
}

// The same for one-step methods: their forces or what a splitting works with, and of each step size the blocks of stages, end and
// forms, or of the linear flows.
double doubles_of_one_step(int order, Index size, bool variable_steps) {
  const double s = order;
  const double blocks = 2 * (2 + 0.5 * s) * s + 2 * (2 + s) + (2 + s) * (3 + s) + 4;
  const double step_sizes = variable_steps ? static_cast<double>(cached_step_sizes(size)) : 1.0;
  return s + 16 + (variable_steps ? 10 : 0) + step_sizes * blocks / 4;
}

double doubles_per_unknown(const MethodEntry& method, Index size, bool variable_steps) {
  switch (method.closure) {
    case ClosureKind::sav: return 12;
    case ClosureKind::dm: return 21;
    case ClosureKind::avf: return 22;
    case ClosureKind::none:
      return method.composition == Composition::collocation ? doubles_of_collocation(method.order, size, variable_steps)
                                                            : doubles_of_one_step(method.order, size, variable_steps);
    case ClosureKind::lm: break;
  }
  return 27;
}

}  // namespace

double run_bytes(const MethodEntry& method, const Problem& problem, bool variable_steps) {
  return 8 * doubles_per_unknown(method, problem.size(), variable_steps) * static_cast<double>(problem.size());
}

}  // namespace seiche
