#include <seiche/backend/force_map.hpp>
#include <seiche/backend/grid_damping.hpp>
#include <seiche/backend/grid_potential.hpp>
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
      : modes_(problem.grid),
        S_symbol_(problem.S),
        M_symbol_(problem.M),
        S_(map([this](Index k) { return S_symbol_.symbol(modes_[k]); })),
        M_(map([this](Index k) { return M_symbol_.symbol(modes_[k]); })),
        absolute_M_(map([this](Index k) -> Block {
          return M_symbol_.symbol(modes_[k]).cwiseAbs().cast<std::complex<double>>();
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
    maps.reserve(static_cast<std::size_t>(modes_.count()));
    for (Index k = 0; k < modes_.count(); ++k) {
      const SizedBlock S = S_symbol_.symbol(modes_[k]);
      const SizedBlock M = M_symbol_.symbol(modes_[k]);
      const ForceMaps<SizedBlock> block = force_maps<SizedBlock>(kind, S, M, h);
      maps.push_back({block.F, block.F * M, block.Q, block.Q * M});
    }
    const auto at = [&](Index k) -> const Maps& { return maps[static_cast<std::size_t>(k)]; };
    return std::make_unique<ModalPropagator>(map([&](Index k) -> Block { return at(k).F; }),
                                             map([&](Index k) -> Block { return at(k).FM; }),
                                             map([&](Index k) -> Block { return at(k).Q; }),
                                             map([&](Index k) -> Block { return at(k).QM; }));
  }

  ModeMap map(const ModeMap::Block& block) const { return ModeMap(modes_, M_symbol_.fields(), block); }

  Modes modes_;
  BlockStencil S_symbol_, M_symbol_;
  ModeMap S_, M_, absolute_M_;
  mutable Vector scratch_, absolute_;
};

void require_symmetric(const BlockStencil& a, std::string_view name) {
  for (Index i = 0; i < a.fields(); ++i)
    for (Index j = 0; j < a.fields(); ++j)
      if (!a(i, j).is_symmetric())
        throw Error("the modal backend needs every axis periodic where {}({}, {}) has a first derivative; use dense",
                    name, i, j);
}

}  // namespace

System modal_system(const Problem& problem, const BackendOptions& options) {
  if (problem.matrices)
    throw Error(
        "the modal backend needs coefficients that are the same at every point, and {} has matrices; use "
        "\"sparse\" or \"dense\"",
        problem.name);
  if (!problem.grid.is_periodic()) {
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
    const Modes modes(problem.grid);
    const auto symbol = [modes, D = problem.damping.constant](Index k) { return D.symbol(modes[k]); };
    constant = std::make_unique<ModeMap>(modes, problem.field_count(), symbol);
    make_flow = [modes, m = problem.field_count(), symbol](double h) {
      return std::make_unique<ModeMap>(modes, m, [&](Index k) { return damping_exponential<Block>(symbol(k), h); });
    };
  }
  system.damping =
      std::make_unique<GridDamping>(problem, transform->slots(), std::move(constant), std::move(make_flow));
  system.initial.resize(system.space->size());
  system.space->from_physical(problem.initial, system.initial);
  return system;
}

}  // namespace seiche
