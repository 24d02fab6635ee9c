#include <seiche/backend/sparse/pade.hpp>
#include <seiche/core/spectral_radius.hpp>
#include <seiche/core/step_cache.hpp>
#include <seiche/petsc/ksp_resolvents.hpp>
#include <seiche/petsc/petsc_damping.hpp>

#include <cmath>
#include <optional>

namespace seiche {
namespace {

class MatrixDamping final : public Damping {
 public:
  MatrixDamping(Mat D, const Space& space, Potential::Support support, const std::string& prefix) : space_(space) {
    if (D == nullptr) return;
    PetscInt first = 0;
    require(MatGetOwnershipRange(D, &first, nullptr));
    bool is_diagonal = true, touches = false;
    diagonal_.setZero(space.size());
    visit_rows(D, [&](Index row, std::span<const PetscInt> columns, std::span<const double> values) {
      const Index here = row - first;
      for (std::size_t k = 0; k < columns.size(); ++k) {
        if (values[k] == 0) continue;
        touches = touches || (here >= support.begin && here < support.begin + support.size);
        if (columns[k] == row)
          diagonal_[here] = values[k];
        else
          is_diagonal = false;
      }
    });
    touches_potential_ = space.any(touches);
    D_.emplace(D);
    if (!space.any(!is_diagonal)) return;
    diagonal_.resize(0);
    require(MatDuplicate(D, MAT_COPY_VALUES, minus_D_.make()));
    require(MatScale(minus_D_, -1));

    resolvents_.emplace(minus_D_, prefix, KspResolvents::Tolerance::round_off);
    radius_ = spectral_radius_bound(D);
  }

  bool is_zero() const override { return !D_; }
  bool touches_potential() const override { return touches_potential_; }
  bool is_constant() const override { return true; }
  void flow(double /*t*/, double h, Vector& z) const override {
    if (!D_) return;
    if (diagonal_.size() == z.size()) {
      z.array() *= factors(h).array();
      return;
    }
    image_.resize(z.size());
    moved_.resize(z.size());
    D_->apply(z, image_);
    flows_
        .at(h,
            [&] {
              return std::make_unique<PadeForce>(minus_I_, *D_, z.size(), *resolvents_, h,
                                                 plan_pade(std::abs(h) * radius_, 1e-15));
            })
        .apply(image_, moved_);
    z += moved_;
  }
  void apply(double /*t*/, const Vector& z, Vector& out) const override { apply_D0(z, out); }
  void apply_rest(double /*t*/, const Vector& /*z*/, Vector& out) const override { out.setZero(); }
  void apply_D0(const Vector& z, Vector& out) const override {
    if (D_)
      D_->apply(z, out);
    else
      out.setZero();
  }
  double largest_rate(const Space& /*space*/, double /*t*/, double /*h*/, const Vector& /*before*/,
                      const Vector& /*after*/) const override {
    if (!rate_) {
      image_.resize(space_.size());
      rate_ = !D_ ? 0.0 : spectral_radius(space_, [this](Vector& z) {
        D_->apply(z, image_);
        z.swap(image_);
      });
    }
    return *rate_;
  }

 private:
  class MinusIdentity final : public Product {
   public:
    void apply(std::span<const double> x, std::span<double> y) const override {
      for (std::size_t i = 0; i < x.size(); ++i) y[i] = -x[i];
    }
  };

  const Vector& factors(double h) const {
    if (h != factors_of_) {
      factors_ = (-h * diagonal_.array()).exp();
      factors_of_ = h;
    }
    return factors_;
  }

  const Space& space_;
  std::optional<PetscProduct> D_;
  Vector diagonal_;
  bool touches_potential_ = false;
  OwnedMat minus_D_;
  MinusIdentity minus_I_;
  std::optional<KspResolvents> resolvents_;
  double radius_ = 0.0;
  mutable StepCache<PadeForce> flows_;
  mutable std::optional<double> rate_;
  mutable double factors_of_ = 0.0;
  mutable Vector factors_, image_, moved_;
};

}  // namespace

std::unique_ptr<Damping> petsc_damping(Mat D, const Space& space, Potential::Support support,
                                       const std::string& prefix) {
  return std::make_unique<MatrixDamping>(D, space, support, prefix);
}

}  // namespace seiche
