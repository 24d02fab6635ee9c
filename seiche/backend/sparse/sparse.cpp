#include <seiche/backend/grid/beyond_linear.hpp>
#include <seiche/backend/grid/grid_damping.hpp>
#include <seiche/backend/grid/grid_potential.hpp>
#include <seiche/backend/grid/grid_space.hpp>
#include <seiche/backend/sparse/grid_kicks.hpp>
#include <seiche/backend/sparse/pade.hpp>
#include <seiche/backend/sparse/sparse.hpp>
#include <seiche/backend/sparse/sparse_damping.hpp>
#include <seiche/backend/sparse/sparse_linear.hpp>
#include <seiche/backend/sparse/sparse_noise.hpp>
#include <seiche/backend/sparse/sparse_phi.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/momenta.hpp>

#include <cmath>

namespace seiche {
namespace {

template <class AnyStencil>
SparseMatrix matrix_of(const Problem& problem, const AnyStencil& stencil) {
  try {
    return stencil.sparse_matrix(problem.grid);
  } catch (const Error& error) {
    throw Error("the sparse backend does not take {}: {}; use discretisation \"fd2\" or \"fd4\", or backend \"modal\"",
                problem.name, error.what());
  }
}

}  // namespace

bool has_grid_kicks(const Problem& problem) {
  if (problem.matrices || !problem.M.is_sparse()) return false;
  const std::optional<Momenta> p = momenta(problem);
  return p && p->inverse_mass == 1 && (!problem.potential || problem.potential->fields() == p->count);
}

double sparse_rate(const Problem& problem) {
  if (problem.matrices)
    return spectral_radius_bound(SparseMatrix(problem.matrices->S * problem.matrices->M) -
                                 constant_damping_matrix(problem));
  return spectral_radius_bound(SparseMatrix(matrix_of(problem, problem.S) * matrix_of(problem, problem.M)) -
                               matrix_of(problem, constant_damping(problem)));
}

System sparse_system(const Problem& problem, const BackendOptions& options) {
  options.sparse.validate();
  const Index n = problem.grid.unknowns();
  const std::shared_ptr<const FieldTransform> identity = identity_transform(n);
  System system;
  system.fields = problem.field_count();
  system.space = std::make_unique<GridSpace>(problem.field_count(), identity);
  system.potential =
      std::make_unique<GridPotential>(problem.potential, problem.potential_field, identity, *system.space);

  std::shared_ptr<const SparseOperators> shared = problem.matrices;
  if (!shared)
    shared =
        std::make_shared<SparseOperators>(SparseOperators{matrix_of(problem, problem.S), matrix_of(problem, problem.M),
                                                          matrix_of(problem, problem.damping.constant)});
  const SparseOperators& matrices = *shared;
  system.linear =
      sparse_linear_part(matrices.S, matrices.M, system.potential->support(), options.sparse, *system.space);

  if (has_grid_kicks(problem))
    system.make_kicks = [shared, V = problem.potential, &potential = *system.potential] {
      const Index positions = shared->M.rows() / 2;
      return grid_kicks(shared->M.topLeftCorner(positions, positions), V, potential);
    };

  const auto D0 = std::make_shared<const SparseMatrix>(
      problem.matrices ? constant_damping_matrix(problem) : constant_damping(problem).sparse_matrix(problem.grid));
  const Potential::Support support = system.potential->support();
  const Space& space = *system.space;
  system.make_phi = [shared, D0, support, &space] { return sparse_phi(shared, *D0, support, space); };
  system.make_undamped_phi = [shared, support, &space] {
    return sparse_phi(shared, SparseMatrix(shared->S.rows(), shared->S.cols()), support, space);
  };

  system.make_noise = [shared, D0](double h) { return sparse_noise(shared->S, shared->M, *D0, h); };

  std::unique_ptr<LinearMap> constant;
  GridDamping::MakeFlow make_flow;
  if (matrices.D.nonZeros() > 0) {
    constant = sparse_map(matrices.D);
    make_flow = sparse_damping_flow(matrices.D);
  }
  system.damping = std::make_unique<GridDamping>(problem, n, std::move(constant), std::move(make_flow));
  add_beyond_linear(system, problem, identity, [&](const Stencil& d) { return sparse_map(matrix_of(problem, d)); });
  system.initial = problem.initial;
  return system;
}

// Measured with lines of 10⁵ points and planes of 300². Matrices are stored by rows and by columns, in pieces and with
// what assembles them; a factor of the Padé propagators has complex entries, on planes some 8 log₂ n of them in a row.
double sparse_bytes(const Problem& problem, double factored) {
  constexpr double of_entry = 240, of_factor_entry = 10;
  const auto points = static_cast<double>(problem.grid.unknowns());
  const auto axes = static_cast<double>(problem.grid.dimension());
  const double entries = problem.matrices
                             ? static_cast<double>(problem.matrices->S.nonZeros() + problem.matrices->M.nonZeros() +
                                                   problem.matrices->D.nonZeros())
                             : static_cast<double>(problem.size()) * (2 + axes);
  const double in_a_row = axes < 2 ? 25 : axes < 3 ? 8 * std::log2(points + 2) : 10 * std::cbrt(points);
  return of_entry * entries + factored * of_factor_entry * in_a_row * points;
}

}  // namespace seiche
