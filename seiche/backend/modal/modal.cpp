#include <seiche/backend/grid/beyond_linear.hpp>
#include <seiche/backend/grid/grid_damping.hpp>
#include <seiche/backend/grid/grid_potential.hpp>
#include <seiche/backend/grid/grid_space.hpp>
#include <seiche/backend/modal/masked_potential.hpp>
#include <seiche/backend/modal/modal.hpp>
#include <seiche/backend/modal/modal_linear.hpp>
#include <seiche/backend/modal/modal_phi.hpp>
#include <seiche/backend/modal/mode_map.hpp>
#include <seiche/backend/phi/force_map.hpp>
#include <seiche/backend/sparse/equal_rows.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/truncated_potential.hpp>
#include <seiche/noise/fluctuation.hpp>

#include <optional>

namespace seiche {
namespace {

using Block = Eigen::MatrixXcd;

void require_symmetric(const BlockStencil& a, std::string_view name) {
  for (Index i = 0; i < a.fields(); ++i)
    for (Index j = 0; j < a.fields(); ++j)
      if (!a(i, j).is_symmetric())
        throw Error("the modal backend needs every axis periodic where {}({}, {}) has a first derivative; use dense",
                    name, i, j);
}

// What several processes do not share yet is refused, where they would compute something else than one.
void require_divisible(const Problem& problem) {
  const auto refuse = [&](bool holds, std::string_view what) {
    if (holds) throw Error("{} has {}, which only one process computes; run it without mpiexec", problem.name, what);
  };
  refuse(problem.grid.dimension() == 1, "a grid of one axis");
  const auto* truncated = dynamic_cast<const TruncatedPotential*>(problem.potential.get());
  const PointwisePotential* V = truncated != nullptr ? truncated->whole().get() : problem.potential.get();
  refuse(V != nullptr && !V->is_pointwise(), "a potential that does not add up over points");
  refuse(problem.structure && problem.structure->dissipates() && problem.derivatives.empty(),
         "a mobility by differences between neighbours");
}

// The mean of γ(x, 0), added up unit by unit.
double mean_rate(const FieldRate& rate, const Space& space) {
  const Space::Field field = space.values();
  Vector gamma(field.size);
  rate.values(0, {gamma.data(), static_cast<std::size_t>(gamma.size())});
  const double sum = space.total(field.units, [&](Index unit) {
    return gamma.segment(field.begin(unit), field.end(unit) - field.begin(unit)).sum();
  });
  return sum / static_cast<double>(field.of);
}

// A truncated V by a mask on the modes instead of its convolutions.
std::unique_ptr<Potential> modal_potential(const Problem& problem,
                                           const std::shared_ptr<const FieldTransform>& transform, const Space& space) {
  const auto* truncated = dynamic_cast<const TruncatedPotential*>(problem.potential.get());
  const auto on_grid = [&](const std::shared_ptr<const PointwisePotential>& V) {
    return std::make_unique<GridPotential>(V, problem.potential_field, transform, space);
  };
  if (truncated == nullptr) return on_grid(problem.potential);
  const Modes modes(problem.grid);
  Vector mask(truncated->fields() * modes.slots());
  for (Index i = 0; i < mask.size(); ++i)
    mask[i] = is_kept(modes[i % modes.slots() / 2]) ? 1.0 : 0.0;  // pairs of slots
  return std::make_unique<MaskedPotential>(on_grid(truncated->whole()), std::move(mask));
}

// S∇V by the differences of S, where it has few kinds of rows; else null. V is of the fields from `first` on, and
// `potential`, which outlives the force, counts how often its slopes are taken.
System::NodalForce nodal_force(const SparseMatrix& S, const std::shared_ptr<const PointwisePotential>& V, Index points,
                               Index first, const Potential& potential) {
  std::optional<EqualRows> rows = EqualRows::of(S);
  if (!rows) return nullptr;
  const Index begin = first * points;
  const auto size = static_cast<std::size_t>(V->fields() * points);
  return [rows = std::move(*rows), V, &potential, begin, size,
          gradient = Vector(Vector::Zero(S.rows()))](const Vector& values, Vector& force) mutable {
    potential.count_gradient();
    V->gradient({values.data() + begin, size}, {gradient.data() + begin, size});
    rows.apply(gradient, force);
  };
}

}  // namespace

System modal_system(const Problem& given, const BackendOptions& options) {
  if (options.threads < 1)
    throw Error("threads = {} of the modal backend must be ≥ 1; 1 runs on the calling thread alone", options.threads);
  if (options.ranks != nullptr) require_divisible(given);
  if (given.matrices)
    throw Error(
        "the modal backend needs coefficients that are the same at every point, and {} has matrices; use "
        "\"sparse\" or \"dense\"",
        given.name);
  if (!given.grid.is_periodic()) {
    require_symmetric(given.S, "S");
    require_symmetric(given.M, "M");
    require_symmetric(given.damping.constant, "D");
  }
  const std::shared_ptr<const FieldTransform> transform =
      modal_transform(given.grid,
                      {.measure_plans = options.measure_plans, .threads = options.threads, .ranks = options.ranks});
  System system;
  system.fields = given.field_count();
  system.space = std::make_unique<GridSpace>(given.field_count(), transform, options.ranks);
  std::optional<Problem> with_mean;
  if (given.damping.field_rate) {
    with_mean = given;
    with_mean->damping.mean_field_rate = mean_rate(*given.damping.field_rate, *system.space);
  }
  const Problem& problem = with_mean ? *with_mean : given;
  system.linear = modal_linear_part(problem, *system.space, options.threads);
  system.potential = modal_potential(problem, transform, *system.space);
  const ModalOperators operators{.grid = problem.grid,
                                 .S = problem.S,
                                 .M = problem.M,
                                 .D0 = constant_damping(problem),
                                 .first = problem.potential_field,
                                 .count = problem.potential ? problem.potential->fields() : 0,
                                 .threads = options.threads};
  system.make_phi = [operators, &space = *system.space] { return modal_phi(operators, space); };
  system.make_undamped_phi = [undamped = operators, &space = *system.space]() mutable {
    undamped.D0 = BlockStencil(undamped.S.fields());
    return modal_phi(undamped, space);
  };

  const bool is_truncated = dynamic_cast<const TruncatedPotential*>(problem.potential.get()) != nullptr;
  // Of one axis: several processes share other grids, and have the same bits as one.
  if (problem.potential && !is_truncated && problem.grid.dimension() == 1 && problem.S.is_sparse())
    system.make_nodal_force = [S = problem.S, grid = problem.grid, V = problem.potential,
                               first = problem.potential_field, &potential = *system.potential] {
      return nodal_force(S.sparse_matrix(grid), V, grid.unknowns(), first, potential);
    };

  system.make_noise = [operators](double h) {
    const Modes modes(operators.grid);
    const bool damped = !operators.D0.is_zero();
    return std::make_unique<ModeMap>(modes, operators.S.fields(), [&](Index k) {
      const auto of = [&](const BlockStencil& a) -> Block { return a.symbol(modes[k]); };
      return fluctuation_root(dissipation(of(operators.S), of(operators.M), of(operators.D0), damped), h);
    });
  };

  std::unique_ptr<LinearMap> constant;
  GridDamping::MakeFlow make_flow;
  if (!problem.damping.constant.is_zero()) {
    const Modes modes(problem.grid);
    const auto symbol = [modes, D = problem.damping.constant](Index k) { return D.symbol(modes[k]); };
    constant = std::make_unique<ModeMap>(modes, problem.field_count(), symbol);
    make_flow = [modes, m = problem.field_count(), symbol](double h) {
      return std::make_unique<ModeMap>(modes, m, [&](Index k) { return damping_exponential<Block>(symbol(k), h); });
    };
  }
  system.damping = std::make_unique<GridDamping>(problem, transform, std::move(constant), std::move(make_flow));
  add_beyond_linear(system, problem, transform, [&](const Stencil& derivative) {
    const Modes modes(problem.grid);
    return std::make_unique<ModeMap>(modes, 1, [&](Index k) -> Block {
      return Block::Constant(1, 1, derivative.symbol(modes[k]));
    });
  });
  system.initial.resize(system.space->size());
  system.space->from_physical(problem.initial, system.initial);
  return system;
}

double modal_bytes(const Problem& problem, double /*factored*/) {
  constexpr double of_unknown = 11;  // measured on planes of 900² points
  return 8 * of_unknown * static_cast<double>(problem.size());
}

}  // namespace seiche
