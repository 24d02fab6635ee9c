#include <seiche/backend/modal/modal_linear.hpp>
#include <seiche/backend/modal/modal_propagator.hpp>
#include <seiche/backend/modal/mode_map.hpp>
#include <seiche/backend/phi/force_map.hpp>

#include <array>
#include <complex>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace seiche {
namespace {

using Block = Eigen::MatrixXcd;

// Any number of fields, any M: entry by entry.
class MappedPropagator final : public PlainPropagator {
 public:
  MappedPropagator(const Space& space, const LinearPart& linear, Potential::Support support, ModeMap F, ModeMap FM,
                   ModeMap Q, ModeMap QM)
      : PlainPropagator(space, linear),
        support_(support),
        F_(std::move(F)),
        FM_(std::move(FM)),
        Q_(std::move(Q)),
        QM_(std::move(QM)) {}

  void predict(const Vector& z, const Vector& gradient, Vector& z_mid, FieldFactors before) const override {
    z_ = z;
    multiply_fields(before, z_);
    result_ = z_;
    QM_.add(z_, result_);
    Q_.add(gradient, result_);
    z_mid.segment(support_.begin, support_.size) = result_.segment(support_.begin, support_.size);
  }
  void increment(const Vector& z, Vector& dz) const override { FM_.apply(z, dz); }
  void force(const Vector& f, Vector& q) const override { F_.apply(f, q); }

 private:
  Potential::Support support_;
  ModeMap F_, FM_, Q_, QM_;
  mutable Vector z_, result_;
};

class ModalLinear final : public LinearPart {
 public:
  ModalLinear(const Problem& problem, const Space& space, int threads)  // `space` outlives it
      : space_(space),
        modes_(problem.grid),
        S_symbol_(problem.S),
        M_symbol_(problem.M),
        extent_{.fields = problem.field_count(),
                .modes = modes_.count(),
                .layout = layout(problem),
                .first = problem.potential_field,
                .count = problem.potential ? problem.potential->fields() : 0,
                .threads = threads} {
    if (!is_diagonal(M_symbol_)) return;
    metric_.emplace(ModalMetric{ModeArrays(extent_.modes, extent_.fields, 1, real_layout()), 0});
    for (Index f = 0; f < extent_.fields; ++f) {
      if (M_symbol_(f, f).is_identity()) metric_->unit |= 1U << static_cast<unsigned>(f);
      for (Index k = 0; k < extent_.modes; ++k) {
        const double factor = M_symbol_(f, f).symbol(modes_[k]).real();
        metric_->factors.set(k, f, 0, factor);
        nonnegative_ = nonnegative_ && factor >= 0;
      }
    }
    nonnegative_ = space_.all(nonnegative_);
    if (!has_fused_propagator(extent_, metric_->unit)) metric_->unit = 0;  // its factors are there all the same
  }

  void apply_S(const Vector& z, Vector& out) const override { map(S_, S_symbol_).apply(z, out); }
  bool apply_symmetric_S(const Vector& z, Vector& out) const override {
    const auto twice = [this](Index k) -> Block {
      const Block S = S_symbol_.symbol(modes_[k]);
      return S + S.adjoint();
    };
    if (!S_is_skew_) {
      S_is_skew_ = true;
      for (Index k = 0; k < extent_.modes && *S_is_skew_; ++k) S_is_skew_ = twice(k).isZero(0);
      S_is_skew_ = space_.all(*S_is_skew_);
    }
    if (*S_is_skew_) return false;
    if (!symmetric_S_)
      symmetric_S_ = std::make_unique<ModeMap>(modes_, extent_.fields, [&](Index k) -> Block { return twice(k) / 2; });
    symmetric_S_->apply(z, out);
    return true;
  }
  void apply_M(const Vector& z, Vector& out) const override {
    if (!metric_) return map(M_, M_symbol_).apply(z, out);
    for (Index f = 0; f < extent_.fields; ++f) {
      const Index begin = f * extent_.slots();
      multiply_modes(extent_.layout, metric_->factors.data(f, 0), z.data() + begin, extent_.slots(),
                     out.data() + begin);
    }
  }

  double quadratic_energy(const Vector& z) const override {
    if (metric_) {
      const Space::Field field = space_.slots();
      const double twice = space_.total(field.units, [&](Index unit) {
        const Index begin = field.begin(unit), size = field.end(unit) - begin;
        double sum = 0;
        for (Index f = 0; f < extent_.fields; ++f) {
          const bool is_unit = (metric_->unit >> static_cast<unsigned>(f) & 1U) != 0;
          sum +=
              weighted_square(extent_.layout,
                              is_unit ? nullptr : metric_->factors.data(f, 0) + begin / slots_per_mode(extent_.layout),
                              z.data() + f * extent_.slots() + begin, size);
        }
        return sum;
      });
      return twice / 2;
    }
    scratch_.resize(z.size());
    apply_M(z, scratch_);
    return space_.dot(z, scratch_) / 2;
  }

  double quadratic_magnitude(const Vector& z) const override {
    if (metric_ && nonnegative_) return quadratic_energy(z);
    if (!absolute_M_) {
      absolute_M_ = std::make_unique<ModeMap>(modes_, extent_.fields, [this](Index k) -> Block {
        return M_symbol_.symbol(modes_[k]).cwiseAbs().cast<std::complex<double>>();
      });
    }
    scratch_.resize(z.size());
    absolute_ = z.cwiseAbs();
    absolute_M_->apply(absolute_, scratch_);
    return space_.dot(absolute_, scratch_) / 2;
  }

  ValueAndMagnitude quadratic(const Vector& z) const override {
    const double energy = quadratic_energy(z);
    return {energy, metric_ && nonnegative_ ? energy : quadratic_magnitude(z)};
  }

  std::unique_ptr<Propagator> propagator(PropagatorKind kind, double h) const override {
    if (metric_ && has_fused_propagator(extent_, metric_->unit))
      return extent_.layout == ModeLayout::complex_pairs ? fused<std::complex<double>>(kind, h)
                                                         : fused<double>(kind, h);
    return mapped(kind, h);
  }

 private:
  static bool is_diagonal(const BlockStencil& a) {
    for (Index i = 0; i < a.fields(); ++i)
      for (Index j = 0; j < a.fields(); ++j)
        if (i == j ? !a(i, i).is_symmetric() : !a(i, j).is_zero()) return false;
    return true;
  }

  static ModeLayout layout(const Problem& problem) {
    if (!problem.grid.is_periodic()) return ModeLayout::singles;
    return problem.S.has_real_symbol() && problem.M.has_real_symbol() ? ModeLayout::real_pairs
                                                                      : ModeLayout::complex_pairs;
  }
  ModeLayout real_layout() const {
    return extent_.layout == ModeLayout::singles ? ModeLayout::singles : ModeLayout::real_pairs;
  }

  template <class Scalar>
  std::unique_ptr<Propagator> fused(PropagatorKind kind, double h) const {
    return extent_.fields == 1 ? fused<Scalar, 1>(kind, h) : fused<Scalar, 2>(kind, h);
  }

  // Blocks of a size known to the compiler, real where they can be: no allocation per mode but for the symbols.
  template <class Scalar, int m>
  std::unique_ptr<Propagator> fused(PropagatorKind kind, double h) const {
    using SizedBlock = Eigen::Matrix<Scalar, m, m>;
    const auto block_of = [&](const BlockStencil& symbol, Index k) {
      SizedBlock block;
      for (Index i = 0; i < m; ++i) {
        for (Index j = 0; j < m; ++j) {
          const std::complex<double> c = symbol(i, j).symbol(modes_[k]);
          if constexpr (std::is_same_v<Scalar, double>) {
            block(i, j) = c.real();
          } else {
            block(i, j) = c;
          }
        }
      }
      return block;
    };
    ModalForceMaps maps{ModeArrays(extent_.modes, m, m, extent_.layout),
                        ModeArrays(extent_.modes, m, m, extent_.layout)};
    for (Index k = 0; k < extent_.modes; ++k) {
      const ForceMaps<SizedBlock> block =
          force_maps<SizedBlock>(kind, block_of(S_symbol_, k), block_of(M_symbol_, k), h);
      for (Index i = 0; i < m; ++i) {
        for (Index j = 0; j < m; ++j) {
          maps.F.set(k, i, j, block.F(i, j));
          maps.Q.set(k, i, j, block.Q(i, j));
        }
      }
    }
    return fused_propagator(space_, extent_, *metric_, std::move(maps));
  }

  std::unique_ptr<Propagator> mapped(PropagatorKind kind, double h) const {
    std::vector<std::array<Block, 4>> blocks;
    blocks.reserve(static_cast<std::size_t>(extent_.modes));
    for (Index k = 0; k < extent_.modes; ++k) {
      const Block M = M_symbol_.symbol(modes_[k]);
      const ForceMaps<Block> block = force_maps<Block>(kind, S_symbol_.symbol(modes_[k]), M, h);
      blocks.push_back({block.F, block.F * M, block.Q, block.Q * M});
    }
    const auto map_of = [&](std::size_t which) {
      return ModeMap(modes_, extent_.fields,
                     [&, which](Index k) { return blocks[static_cast<std::size_t>(k)][which]; });
    };
    const Potential::Support support{extent_.first * extent_.slots(), extent_.count * extent_.slots()};
    return std::make_unique<MappedPropagator>(space_, *this, support, map_of(0), map_of(1), map_of(2), map_of(3));
  }

  // Built when first asked for: steps do not need them.
  const ModeMap& map(std::unique_ptr<ModeMap>& map, const BlockStencil& symbol) const {
    if (!map)
      map = std::make_unique<ModeMap>(modes_, extent_.fields, [&](Index k) { return symbol.symbol(modes_[k]); });
    return *map;
  }

  const Space& space_;
  Modes modes_;
  BlockStencil S_symbol_, M_symbol_;
  ModalExtent extent_;
  std::optional<ModalMetric> metric_;  // where M is diagonal
  bool nonnegative_ = true;            // is it? then ½|z|ᵀ|M||z| is ½zᵀMz
  mutable std::unique_ptr<ModeMap> S_, M_, absolute_M_, symmetric_S_;
  mutable std::optional<bool> S_is_skew_;  // once it was asked for
  mutable Vector scratch_, absolute_;
};

}  // namespace

std::unique_ptr<LinearPart> modal_linear_part(const Problem& problem, const Space& space, int threads) {
  return std::make_unique<ModalLinear>(problem, space, threads);
}

}  // namespace seiche
