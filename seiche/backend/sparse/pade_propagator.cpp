#include <seiche/backend/sparse/pade_propagator.hpp>

#include <Eigen/SVD>

#include <algorithm>
#include <array>
#include <cmath>

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

// With q = Ff and y_j = Fw_j of the vectors before it, the contract says
//   e_j = w_jᵀq + fᵀy_j + y_jᵀMq = 0  and  2fᵀq + qᵀMq = 0:
// Newton's method for q + Σ a_j y_j + a q finds the a that q misses.
class Restoration {
 public:
  Restoration(const Product& M, const Space& space, double& moved)
      : M_(M), space_(space), moved_(moved), Mq_(space.size()) {
    for (Pair& pair : before_)
      for (Vector* v : {&pair.w, &pair.y, &pair.My}) v->resize(space.size());
  }

  void start(const Vector& w, Vector& y) {
    known_ = 0;
    follow(w, y);
  }
  // Of what follows the first and the second vector, each is restored against these two.
  void follow(const Vector& f, Vector& q) {
    for (int round = 0; round < most_rounds && misses(f, q); ++round) move(f, q);
    if (known_ == before_.size()) return;
    Pair& pair = before_[known_++];
    pair.w = f;
    pair.y = q;
    M_.apply(q, pair.My);
  }

 private:
  struct Pair {
    Vector w, y, My;
  };
  static constexpr int most = 3, most_rounds = 8;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;
  using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1>;

  double dot(const Vector& a, const Vector& b) const { return space_.dot(a, b); }

  const Vector& y(Index i, const Vector& q) const {
    return i < std::ssize(before_) && i < static_cast<Index>(known_) ? before_[static_cast<std::size_t>(i)].y : q;
  }

  // Sets e, in units of the sizes of its terms; true where one is more than round-off.
  bool misses(const Vector& f, const Vector& q) {
    const auto n = static_cast<Index>(known_);
    const auto length = [this](const Vector& v) { return space_.norm(v); };
    M_.apply(q, Mq_);
    e_.resize(n + 1);
    size_.resize(n + 1);
    const double of_f = length(f), of_q = length(q);
    for (Index j = 0; j < n; ++j) {
      const Pair& pair = before_[static_cast<std::size_t>(j)];
      size_[j] = of_q * (length(pair.w) + length(pair.My)) + of_f * length(pair.y);
      e_[j] = dot(pair.w, q) + dot(f, pair.y) + dot(pair.My, q);
    }
    size_[n] = of_q * (2 * of_f + length(Mq_));
    e_[n] = 2 * dot(f, q) + dot(q, Mq_);
    bool misses = false;
    for (Index j = 0; j <= n; ++j) {
      if (size_[j] == 0) size_[j] = 1;  // at rest, or without a force
      e_[j] /= size_[j];
      misses = misses || std::abs(e_[j]) > 2 * epsilon;
    }
    return misses;
  }

  // One step of Newton's method from there.
  void move(const Vector& f, Vector& q) {
    const auto n = static_cast<Index>(known_);
    const double of_q = space_.norm(q);
    Matrix J(n + 1, n + 1);
    for (Index i = 0; i <= n; ++i) {
      const Vector& direction = y(i, q);
      const double length = space_.norm(direction);
      const double unit = length > 0 ? of_q / length : 0;  // every direction as long as q
      for (Index j = 0; j < n; ++j) {
        const Pair& pair = before_[static_cast<std::size_t>(j)];
        J(j, i) = unit * (dot(pair.w, direction) + dot(pair.My, direction)) / size_[j];
      }
      J(n, i) = unit * 2 * (dot(f, direction) + dot(Mq_, direction)) / size_[n];
    }
    // At rest, without a force, or where two forces are nearly one, there are fewer directions to move in.
    Eigen::JacobiSVD<Matrix> svd(J, Eigen::ComputeFullU | Eigen::ComputeFullV);
    svd.setThreshold(1e-12);
    if (svd.rank() == 0) return;
    const Coefficients a = svd.solve(-e_);
    if (!a.allFinite()) return;
    moved_ = std::max(moved_, a.cwiseAbs().maxCoeff());
    q *= 1 + a[n];
    for (Index i = 0; i < n; ++i) {
      const Vector& direction = y(i, q);
      const double length = space_.norm(direction);
      if (length > 0) q += (a[i] * of_q / length) * direction;
    }
  }

  const Product& M_;
  const Space& space_;
  double& moved_;
  std::array<Pair, most - 1> before_;
  std::size_t known_ = 0;
  Coefficients e_, size_;
  Vector Mq_;
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
