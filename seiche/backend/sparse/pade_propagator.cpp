#include <seiche/backend/krylov/restoration.hpp>
#include <seiche/backend/sparse/pade_propagator.hpp>

namespace seiche {
namespace {

// Everything is F applied to something: FMz + Ff = F(Mz + f), one pass over the factors.
class PadePropagator : public Propagator {
 public:
  PadePropagator(const Product& M, const Space& space, Potential::Support support, std::unique_ptr<PadeForce> F,
                 std::unique_ptr<PadeForce> Q)
      : M_(M), space_(space), support_(support), F_(std::move(F)), Q_(std::move(Q)) {
    for (Vector* v : {&z_, &c_, &y_, &q_}) v->resize(space.size());
  }

  // ẑ = z⁻ + Q(Mz⁻ + ∇V(z⁻))
  void predict(const Vector& z, const Vector& gradient, Vector& z_mid, FieldFactors before) const override {
    set_slope(z, before);
    const auto [begin, size] = support_;
    c_.segment(begin, size) += gradient.segment(begin, size);
    (Q_ ? Q_ : F_)->apply(c_, y_);
    z_mid.segment(begin, size) = z_.segment(begin, size) + (Q_ ? 1.0 : 0.5) * y_.segment(begin, size);
  }
  void increment(const Vector& z, Vector& dz) const override {
    M_.apply(z, c_);
    F_->apply(c_, dz);
  }
  void force(const Vector& f, Vector& q) const override { F_->apply(f, q); }

  Powers powers(const Vector& z, const Vector& f, FieldFactors before) const override {
    set_slope(z, before);
    const double quadratic_energy = space_.dot(z_, c_) / 2;
    F_->apply(c_, y_);
    F_->apply(f, q_);
    return {space_.dot(f, y_), space_.dot(f, q_), quadratic_energy};
  }
  void update(Vector& z, const Vector& /*f*/, double c, FieldFactors /*before*/, FieldFactors after) const override {
    z = z_ + y_ + c * q_;
    multiply_fields(after, z);
  }

 protected:
  const Space& space() const { return space_; }
  Vector& increment_of_state() const { return y_; }
  Vector& force_of_gradient() const { return q_; }
  const Vector& slope() const { return c_; }

 private:
  void set_slope(const Vector& z, FieldFactors before) const {  // z_ = z⁻, c_ = Mz⁻
    z_ = z;
    multiply_fields(before, z_);
    M_.apply(z_, c_);
  }

  const Product& M_;
  const Space& space_;
  Potential::Support support_;
  std::unique_ptr<PadeForce> F_, Q_;
  mutable Vector z_, c_, y_, q_;  // z⁻, Mz⁻ (in `predict` with ∇V), FMz⁻, Ff
};

class RestoringPadePropagator final : public PadePropagator {
 public:
  RestoringPadePropagator(const Product& M, const Space& space, Potential::Support support,
                          std::unique_ptr<PadeForce> F, std::unique_ptr<PadeForce> Q, double& moved)
      : PadePropagator(M, space, support, std::move(F), std::move(Q)), restoration_(M, space, moved) {}

  void increment(const Vector& z, Vector& dz) const override {
    PadePropagator::increment(z, dz);
    restoration_.start(slope(), dz);
  }
  void force(const Vector& f, Vector& q) const override {
    PadePropagator::force(f, q);
    restoration_.follow(f, q);
  }
  Powers powers(const Vector& z, const Vector& f, FieldFactors before) const override {
    Powers powers = PadePropagator::powers(z, f, before);
    restoration_.start(slope(), increment_of_state());
    restoration_.follow(f, force_of_gradient());
    powers.of_increment = space().dot(f, increment_of_state());
    powers.of_force = space().dot(f, force_of_gradient());
    return powers;
  }

 private:
  mutable Restoration restoration_;
};

}  // namespace

std::unique_ptr<Propagator> restoring_pade_propagator(const Product& M, const Space& space, Potential::Support support,
                                                      std::unique_ptr<PadeForce> F, std::unique_ptr<PadeForce> Q,
                                                      double& moved) {
  return std::make_unique<RestoringPadePropagator>(M, space, support, std::move(F), std::move(Q), moved);
}

std::unique_ptr<Propagator> pade_propagator(const Product& M, const Space& space, Potential::Support support,
                                            std::unique_ptr<PadeForce> F, std::unique_ptr<PadeForce> Q) {
  return std::make_unique<PadePropagator>(M, space, support, std::move(F), std::move(Q));
}

}  // namespace seiche
