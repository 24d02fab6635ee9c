#include <seiche/backend/krylov/krylov_space.hpp>
#include <seiche/backend/krylov/lanczos.hpp>
#include <seiche/backend/krylov/restoration.hpp>

#include <optional>

namespace seiche {
namespace {

class LanczosPropagator final : public Propagator {
 public:
  LanczosPropagator(std::shared_ptr<const SkewSystem> system, Potential::Support support, double h, int dimension,
                    double* moved)
      : system_(std::move(system)),
        support_(support),
        h_(h),
        dimension_(dimension),
        joint_(system_->S, system_->M, system_->space),
        alone_(joint_) {
    if (moved != nullptr) restoration_.emplace(system_->M, system_->space, *moved);
  }

  // ẑ = z⁻ + (e^{hSM/2} − I)(z⁻ + M⁻¹∇V(z⁻))
  void predict(const Vector& z, const Vector& gradient, Vector& z_mid, FieldFactors before) const override {
    const auto [begin, size] = support_;
    w_.setZero(z.size());
    w_.segment(begin, size) = gradient.segment(begin, size);
    system_->divide_by_M(w_);
    z_ = z;
    multiply_fields(before, z_);
    w_ += z_;
    change(w_, h_ / 2, z_);
    z_mid.segment(begin, size) = z_.segment(begin, size);
  }
  void increment(const Vector& z, Vector& dz) const override {
    dz.setZero(z.size());
    change(z, h_, dz);
    if (!restoration_) return;
    w_.resize(z.size());
    system_->M.apply(z, w_);
    restoration_->start(w_, dz);
  }
  void force(const Vector& f, Vector& q) const override {
    w_ = f;
    system_->divide_by_M(w_);
    q.setZero(f.size());
    change(w_, h_, q);
    if (restoration_) restoration_->follow(f, q);
  }

  // In the space of z⁻ and M⁻¹f, the columns of V R: f = M V R e₂, so that fᵀy is a product of coordinates.
  Powers powers(const Vector& z, const Vector& f, FieldFactors before) const override {
    w_ = f;
    system_->divide_by_M(w_);
    z_ = z;
    multiply_fields(before, z_);
    start_.resize(z.size(), 2);
    start_ << z_, w_;
    joint_.build(start_, h_, dimension_);
    const Eigen::MatrixXd& R = joint_.coordinates();
    const Eigen::MatrixXd& change = joint_.change();
    return {R.col(1).dot(change.col(0)), R.col(1).dot(change.col(1)), R.col(0).squaredNorm() / 2};
  }
  void update(Vector& z, const Vector& /*f*/, double c, FieldFactors /*before*/, FieldFactors after) const override {
    const Eigen::MatrixXd& change = joint_.change();
    z = z_;
    joint_.add(change.col(0) + c * change.col(1), z);
    multiply_fields(after, z);
  }

 private:
  // out += (e^{hSM} − I)w
  void change(const Vector& w, double h, Vector& out) const {
    alone_.build(w, h, 0);
    alone_.add(alone_.change().col(0), out);
  }

  std::shared_ptr<const SkewSystem> system_;
  Potential::Support support_;
  double h_;
  int dimension_;
  mutable KrylovSpace joint_, alone_;
  mutable Eigen::MatrixXd start_;
  mutable std::optional<Restoration> restoration_;
  mutable Vector w_, z_;
};

}  // namespace

Error lanczos_needs_skew_S() {
  return Error(
      "exponential = \"lanczos\" needs a skew S; with damping merged into S, or another S, use exponential = \"pade\"");
}

Error lanczos_needs_definite_M(const std::string& found) {
  return Error("exponential = \"lanczos\" needs M positive definite, but {}; use exponential = \"pade\"", found);
}

std::unique_ptr<Propagator> lanczos_propagator(std::shared_ptr<const SkewSystem> system, Potential::Support support,
                                               double h, int dimension, double* moved) {
  return std::make_unique<LanczosPropagator>(std::move(system), support, h, dimension, moved);
}

}  // namespace seiche
