#include <seiche/method/method_memory.hpp>
#include <seiche/simulation/run_memory.hpp>

#include <algorithm>

namespace seiche {
namespace {

// Unknowns of a mode, two fields at most: a field has two where its grid is periodic along every axis, and else one
// (core/grid/modes). Where there are no modes, maps by Krylov spaces keep vectors, about a quarter of that.
double unknowns_per_mode(const Problem& problem, const BackendEntry& backend) {
  return static_cast<double>(std::min<Index>(problem.field_count(), 2)) * (problem.grid.is_periodic() ? 2 : 1) *
         (backend.exponentials_by_krylov ? 4 : 1);
}

// Gradient flows have a block on the diagonal of S that is not skew.
bool is_accelerated(const MethodEntry& method, const Problem& problem) {
  if (method.kind.doubles_with_tables != doubles_of_collocation) return false;
  for (Index i = 0; i < problem.field_count() && !problem.matrices; ++i)
    if (!problem.S(i, i).is_zero() && problem.S(i, i).is_symmetric()) return true;
  return false;
}

double doubles_per_unknown(const MethodEntry& method, Index size, bool variable_steps, double per_mode) {
  const MethodKind& kind = method.kind;
  if (kind.doubles_with_tables) return kind.doubles_with_tables(method.order, size, variable_steps, per_mode);
  return kind.doubles + (variable_steps ? doubles_of_estimate(size, per_mode) : 0);
}

// Friction, forces and what of S changes with z work on values at the points; and where such things stand, the forces
// of collocation are states instead of gradients, with tables to match (measured: 1.6 times as much).
double doubles_of_drives(const MethodEntry& method, const Problem& problem, double without) {
  double doubles = 0;
  if (problem.friction) doubles += 4;
  if (problem.has_forces()) doubles += 2;
  if (problem.structure) doubles += 5;
  return doubles + (doubles > 0 && !method.has_closure() ? 0.7 * without : 0);
}

}  // namespace

double run_bytes(const MethodEntry& method, const BackendEntry& backend, const Problem& problem, bool variable_steps) {
  const double doubles =
      doubles_per_unknown(method, problem.size(), variable_steps, unknowns_per_mode(problem, backend));
  const double factored = method.has_closure() ? step_sizes(problem.size(), variable_steps) : 0;
  const double all = doubles + doubles_of_drives(method, problem, doubles) +
                     (is_accelerated(method, problem) ? doubles_of_acceleration(method.order) : 0);
  return 8 * all * static_cast<double>(problem.size()) + (backend.bytes ? backend.bytes(problem, factored) : 0);
}

double simulation_bytes(const MethodEntry& method, const BackendEntry& backend, const Problem& problem,
                        bool variable_steps) {
  constexpr double beside = 5;  // doubles per unknown, of the 2 to 10 by which runs of six methods take more
  return run_bytes(method, backend, problem, variable_steps) - 8 * beside * static_cast<double>(problem.size());
}

}  // namespace seiche
