#include <seiche/backend/sparse/sparse_damping.hpp>
#include <seiche/core/spectral_radius.hpp>
#include <seiche/core/step_cache.hpp>
#include <seiche/petsc/petsc_damping.hpp>
#include <seiche/petsc/solver/ksp_resolvents.hpp>

#include <optional>

namespace seiche {
namespace {

class PetscMap final : public LinearMap {
 public:
  explicit PetscMap(Mat a) : a_(a) {}
  void apply(const Vector& in, Vector& out) const override { a_.apply(in, out); }

 private:
  PetscProduct a_;
};

class MatrixDamping final : public Damping {
 public:
  MatrixDamping(Mat D, const Space& space, Potential::Support support, const SolverOptions& options)
      : space_(space), flows_(cached_step_sizes(space.size_of_all())), image_(space.size()) {
    if (D == nullptr) return;
    touches_potential_ = space.any(has_entries(D, support));
    D_ = petsc_map(D);
    make_flow_ = petsc_damping_flow(D, space, options);
  }

  bool is_zero() const override { return !D_; }
  bool touches_potential() const override { return touches_potential_; }
  bool is_constant() const override { return true; }
  void flow(double /*t*/, double h, Vector& z) const override {
    if (!D_) return;
    flows_.at(h, [&] { return make_flow_(h); }).apply(z, image_);
    z.swap(image_);
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
    if (!rate_)
      rate_ = !D_ ? 0.0 : spectral_radius(space_, [this](Vector& z) {
        D_->apply(z, image_);
        z.swap(image_);
      });
    return *rate_;
  }

 private:
  const Space& space_;
  std::unique_ptr<LinearMap> D_;  // null: none
  std::function<std::unique_ptr<LinearMap>(double h)> make_flow_;
  bool touches_potential_ = false;
  mutable StepCache<LinearMap> flows_;
  mutable std::optional<double> rate_;
  mutable Vector image_;
};

}  // namespace

std::unique_ptr<LinearMap> petsc_map(Mat a) { return std::make_unique<PetscMap>(a); }

std::function<std::unique_ptr<LinearMap>(double)> petsc_damping_flow(Mat D, const Space& space,
                                                                     const SolverOptions& options) {
  Vector diagonal = Vector::Zero(local_rows(D));
  bool is_diagonal = true;
  visit_rows(D, [&](Index row, std::span<const PetscInt> columns, std::span<const double> values) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (columns[k] == row)
        diagonal[row - first_row(D)] = values[k];
      else
        is_diagonal = is_diagonal && values[k] == 0;
    }
  });
  if (space.all(is_diagonal))
    return [diagonal = std::move(diagonal)](double h) { return diagonal_map((-h * diagonal.array()).exp().matrix()); };
  OwnedMat minus_D;
  require(MatDuplicate(D, MAT_COPY_VALUES, minus_D.make()));
  require(MatScale(minus_D, -1));
  return [D_times = std::make_shared<PetscProduct>(D), radius = spectral_radius_bound(D),
          resolvents = std::make_shared<KspResolvents>(minus_D, options, 0, KspResolvents::Tolerance::round_off),
          size = local_rows(D)](double h) { return pade_decay(D_times, radius, resolvents, size, h); };
}

std::unique_ptr<Damping> petsc_damping(Mat D, const Space& space, Potential::Support support,
                                       const SolverOptions& options) {
  return std::make_unique<MatrixDamping>(D, space, support, options);
}

}  // namespace seiche
