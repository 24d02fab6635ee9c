#include <seiche/simulation/run_memory.hpp>

#include <cmath>

namespace seiche {
namespace {

// Real numbers to a mode: of grids that are periodic along every axis two, and else one (core/grid/modes).
double slots_of(const Grid& grid) {
  for (const GridAxis& axis : grid.axes)
    if (axis.boundary != Boundary::periodic) return 1;
  return 2;
}

double doubles_per_unknown(const MethodEntry& method, Index size, bool variable_steps, double slots) {
  const MethodKind& kind = method.kind;
  return kind.doubles_with_tables ? kind.doubles_with_tables(method.order, size, variable_steps, slots) : kind.doubles;
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

// Measured with lines of 10⁵ points and planes of 300². Matrices are stored by rows and by columns, in pieces and with
// what assembles them; a factor of the Padé propagators has complex entries, on planes some 8 log₂ n of them in a row.
double bytes_of_sparse(const MethodEntry& method, const Problem& problem) {
  constexpr double of_entry = 240, of_factor_entry = 20;
  const auto points = static_cast<double>(problem.grid.unknowns());
  const auto axes = static_cast<double>(problem.grid.dimension());
  const double entries = problem.matrices
                             ? static_cast<double>(problem.matrices->S.nonZeros() + problem.matrices->M.nonZeros() +
                                                   problem.matrices->D.nonZeros())
                             : static_cast<double>(problem.size()) * (2 + axes);
  const bool factorises = method.has_closure();
  const double in_a_row = axes < 2 ? 25 : axes < 3 ? 8 * std::log2(points + 2) : 10 * std::cbrt(points);
  return of_entry * entries + (factorises ? of_factor_entry * in_a_row * points : 0);
}

}  // namespace

double run_bytes(const MethodEntry& method, const Problem& problem, bool variable_steps, std::string_view backend) {
  const double doubles = doubles_per_unknown(method, problem.size(), variable_steps, slots_of(problem.grid));
  const double all = doubles + doubles_of_drives(method, problem, doubles);
  return 8 * all * static_cast<double>(problem.size()) + (backend == "sparse" ? bytes_of_sparse(method, problem) : 0);
}

}  // namespace seiche
