#include <seiche/backend/force_map.hpp>
#include <seiche/backend/grid_space.hpp>
#include <seiche/backend/modal.hpp>
#include <seiche/backend/mode_map.hpp>
#include <seiche/core/error.hpp>

namespace seiche {
namespace {

using Block = Eigen::MatrixXcd;

class ModalPropagator final : public Propagator {
 public:
  ModalPropagator(ModeMap F, ModeMap FM, ModeMap Q, ModeMap QM)
      : F_(std::move(F)), FM_(std::move(FM)), Q_(std::move(Q)), QM_(std::move(QM)) {}

  void predict(const Vector& z, const Vector& gradient, Vector& z_mid) const override {
    z_mid = z;
    QM_.add(z, z_mid);
    Q_.add(gradient, z_mid);
  }
  void increment(const Vector& z, Vector& dz) const override { FM_.apply(z, dz); }
  void force(const Vector& f, Vector& q) const override { F_.apply(f, q); }

 private:
  ModeMap F_, FM_, Q_, QM_;
};

class ModalLinear final : public LinearPart {
 public:
  explicit ModalLinear(const Problem& problem)
      : grid_(problem.grid),
        S_symbol_(problem.S),
        M_symbol_(problem.M),
        S_(map([this](Index k, Index period) { return S_symbol_.symbol(k, period); })),
        M_(map([this](Index k, Index period) { return M_symbol_.symbol(k, period); })),
        absolute_M_(map([this](Index k, Index period) -> Block {
          return M_symbol_.symbol(k, period).cwiseAbs().cast<std::complex<double>>();
        })) {}

  void apply_S(const Vector& z, Vector& out) const override { S_.apply(z, out); }
  void apply_M(const Vector& z, Vector& out) const override { M_.apply(z, out); }

  double quadratic_energy(const Vector& z) const override {
    scratch_.resize(z.size());
    M_.apply(z, scratch_);
    return z.dot(scratch_) / 2;
  }

  double quadratic_magnitude(const Vector& z) const override {
    scratch_.resize(z.size());
    absolute_.resize(z.size());
    absolute_ = z.cwiseAbs();
    absolute_M_.apply(absolute_, scratch_);
    return absolute_.dot(scratch_) / 2;
  }

  std::unique_ptr<Propagator> propagator(PropagatorKind kind, double h) const override {
    switch (M_symbol_.fields()) {  // blocks of a size known to the compiler: no allocation per mode
      case 1: return sized_propagator<1>(kind, h);
      case 2: return sized_propagator<2>(kind, h);
      default: return sized_propagator<Eigen::Dynamic>(kind, h);
    }
  }

 private:
  template <int m>
  std::unique_ptr<Propagator> sized_propagator(PropagatorKind kind, double h) const {
    using SizedBlock = Eigen::Matrix<std::complex<double>, m, m>;
    struct Maps {
      SizedBlock F, FM, Q, QM;
    };
    std::vector<Maps> maps;
    const Modes range = modes(grid_);
    maps.reserve(static_cast<std::size_t>(range.count));
    for (Index k = range.first; k < range.first + range.count; ++k) {
      const SizedBlock S = S_symbol_.symbol(k, range.period);
      const SizedBlock M = M_symbol_.symbol(k, range.period);
      const ForceMaps<SizedBlock> block = force_maps<SizedBlock>(kind, S, M, h);
      maps.push_back({block.F, block.F * M, block.Q, block.Q * M});
    }
    const auto at = [&](Index k) -> const Maps& { return maps[static_cast<std::size_t>(k - range.first)]; };
    return std::make_unique<ModalPropagator>(map([&](Index k, Index) -> Block { return at(k).F; }),
                                             map([&](Index k, Index) -> Block { return at(k).FM; }),
                                             map([&](Index k, Index) -> Block { return at(k).Q; }),
                                             map([&](Index k, Index) -> Block { return at(k).QM; }));
  }

  ModeMap map(const ModeMap::Block& block) const { return ModeMap(grid_, M_symbol_.fields(), block); }

  Grid grid_;
  BlockStencil S_symbol_, M_symbol_;
  ModeMap S_, M_, absolute_M_;
  mutable Vector scratch_, absolute_;
};

void require_symmetric(const BlockStencil& a, std::string_view name) {
  for (Index i = 0; i < a.fields(); ++i)
    for (Index j = 0; j < a.fields(); ++j)
      if (!a(i, j).is_symmetric())
        throw Error("the modal backend needs symmetric stencils at Dirichlet ends, but {}({}, {}) is not; use dense",
                    name, i, j);
}

}  // namespace

System modal_system(const Problem& problem, const BackendOptions& options) {
  if (problem.grid.boundary == Boundary::dirichlet) {
    require_symmetric(problem.S, "S");
    require_symmetric(problem.M, "M");
    require_symmetric(problem.damping.constant, "D");
  }
  const std::shared_ptr<const FieldTransform> transform = modal_transform(problem.grid, options.measure_plans);
  System system;
  system.space = std::make_unique<GridSpace>(problem.field_count(), transform);
  system.linear = std::make_unique<ModalLinear>(problem);
  system.potential = std::make_unique<GridPotential>(problem, transform);

  std::unique_ptr<LinearMap> constant;
  GridDamping::MakeFlow make_flow;
  if (!problem.damping.constant.is_zero()) {
    const auto symbol = [D = problem.damping.constant](Index k, Index period) { return D.symbol(k, period); };
    constant = std::make_unique<ModeMap>(problem.grid, problem.field_count(), symbol);
    make_flow = [grid = problem.grid, m = problem.field_count(), symbol](double h) {
      return std::make_unique<ModeMap>(grid, m, [&](Index k, Index period) {
        return damping_exponential<Block>(symbol(k, period), h);
      });
    };
  }
  system.damping =
      std::make_unique<GridDamping>(problem, transform->slots(), std::move(constant), std::move(make_flow));
  system.initial.resize(system.space->size());
  system.space->from_physical(problem.initial, system.initial);
  return system;
}

}  // namespace seiche
