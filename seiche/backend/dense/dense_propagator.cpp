#include <seiche/backend/dense/dense_propagator.hpp>
#include <seiche/core/numerics/norm_bound.hpp>
#include <seiche/core/simd/with_lanes.hpp>

#include <algorithm>
#include <tuple>
#include <utility>

namespace seiche {
namespace {

using Matrix = Eigen::MatrixXd;

// visit(begin, end, factor) for each field of so many numbers.
template <class Visit>
[[gnu::always_inline]] inline void for_fields(Propagator::FieldFactors factors, Index size, const Visit& visit) {
  if (factors.empty()) return visit(Index{0}, size, 1.0);
  const Index fields = std::ssize(factors), slots = fields == 1 ? size : size / fields;
  for (Index f = 0; f < fields; ++f) visit(f * slots, (f + 1) * slots, factors[static_cast<std::size_t>(f)]);
}

template <class V>
[[gnu::always_inline]] inline double product_of(const double* x, const double* y, Index n) {
  return sum_lanes<V>(
      0,
      n, [=]<class X>(Index j, const X&) __attribute__((always_inline)) { return X(load<X>(x + j) * load<X>(y + j)); });
}

// z⁻ = Λz
void damp_fields(Propagator::FieldFactors factors, const double* z, Index size, double* damped) {
  with_lanes([=]<class V>() __attribute__((always_inline)) {
    for_fields(
        factors, size, [=](Index begin, Index end, double factor) __attribute__((always_inline)) {
          for_lanes<V>(
              begin, end, [=]<class X>(Index j, const X&) __attribute__((always_inline)) {
                store<X>(damped + j, factor * load<X>(z + j));
              });
        });
  });
}

// Λ'(z + dz + c q)
void add_and_damp(const double* z, const double* dz, double c, const double* q, Propagator::FieldFactors factors,
                  Index size, double* out) {
  with_lanes([=]<class V>() __attribute__((always_inline)) {
    for_fields(
        factors, size, [=](Index begin, Index end, double factor) __attribute__((always_inline)) {
          for_lanes<V>(
              begin, end, [=]<class X>(Index j, const X&) __attribute__((always_inline)) {
                store<X>(out + j, factor * (load<X>(z + j) + load<X>(dz + j) + c * load<X>(q + j)));
              });
        });
  });
}

// xᵀy and xᵀz
std::pair<double, double> products(const double* x, const double* y, const double* z, Index n) {
  return with_lanes([=]<class V>() __attribute__((always_inline)) {
    return std::pair(product_of<V>(x, y, n), product_of<V>(x, z, n));
  });
}

// sum = a + b; |b|²
double add_and_measure(const double* a, const double* b, Index n, double* sum) {
  return with_lanes([=]<class V>() __attribute__((always_inline)) {
    return sum_lanes<V>(
        0, n, [=]<class X>(Index j, const X&) __attribute__((always_inline)) {
          const X added = load<X>(b + j);
          store<X>(sum + j, load<X>(a + j) + added);
          return X(added * added);
        });
  });
}

// next = g₀ + weight·(g₀ − g₁); |g₀ − g₁ − ratio·(g₁ − g₂)|²
double extrapolate(const double* g0, const double* g1, const double* g2, double weight, double ratio, Index n,
                   double* next) {
  return with_lanes([=]<class V>() __attribute__((always_inline)) {
    return sum_lanes<V>(
        0, n, [=]<class X>(Index j, const X&) __attribute__((always_inline)) {
          const X newest = load<X>(g0 + j), last = load<X>(g1 + j), change = newest - last;
          store<X>(next + j, newest + weight * change);
          const X second = change - ratio * (last - load<X>(g2 + j));
          return X(second * second);
        });
  });
}

class DensePropagator final : public Propagator {
 public:
  DensePropagator(const DenseForce& maps, const DenseMetric& metric, Potential::Support support)
      : size_(maps.F.rows()),
        support_(support),
        metric_(metric),
        all_F_(maps.F),
        F_(maps.F.middleCols(support.begin, support.size)),
        FM_(maps.FM),
        in_energy_(maps.T.size() > 0) {
    const auto of_support = [&](const Matrix& Q) -> Matrix {
      if (in_energy_) return maps.T.middleRows(support.begin, support.size) * Q;
      return Q.middleRows(support.begin, support.size);
    };
    Matrix mid(support.size, size_ + support.size);
    mid << of_support(maps.QM), of_support(maps.Q).middleCols(support.begin, support.size);
    mid_ = LaneMatrix(mid);
    gradient_share_ = squared_norm_bound(mid.rightCols(support.size));
    if (in_energy_) T_ = LaneMatrix(maps.T);
    z_and_gradient_.resize(size_ + support.size);
    y_.resize(T_.padded_rows());
    for (Vector* v : {&dz_, &q_}) v->resize(std::max(FM_.padded_rows(), mid_.padded_rows()));
  }

  // ẑ = z⁻ + Q(Mz⁻ + ∇V), as one matrix times (z⁻, ∇V)
  void predict(const Vector& z, const Vector& gradient, Vector& z_mid, FieldFactors before) const override {
    damp(z, before);
    std::copy_n(gradient.data() + support_.begin, support_.size, z_and_gradient_.data() + size_);
    move_to_midpoint(z_mid);
  }
  bool recall(const Vector& z, const Gradients& g, Vector& z_mid, FieldFactors before,
              Recalled& recalled) const override {
    damp(z, before);
    const auto of_support = [this](const Vector& v) { return v.data() + support_.begin; };
    recalled.missed = gradient_share_ * extrapolate(of_support(g.g0), of_support(g.g1), of_support(g.g2), g.weight,
                                                    g.ratio, support_.size, z_and_gradient_.data() + size_);
    recalled.missed_is_rough = true;
    recalled.moved = move_to_midpoint(z_mid);
    return true;
  }
  void increment(const Vector& z, Vector& dz) const override {
    FM_.apply(z.data(), dz_.data());
    to_state(dz_);
    dz = dz_.head(size_);
  }
  void force(const Vector& f, Vector& q) const override {
    if (!in_energy_) {
      q.noalias() = all_F_ * f;
      return;
    }
    q_.head(size_).noalias() = all_F_ * f;
    to_state(q_);
    q = q_.head(size_);
  }

  Powers powers(const Vector& z, const Vector& f, FieldFactors before) const override {
    damp(z, before);
    const double* const of_support = f.data() + support_.begin;
    FM_.apply(z_and_gradient_.data(), dz_.data());
    F_.apply(of_support, q_.data());
    to_state(dz_);
    to_state(q_);
    Powers powers{.quadratic_energy = metric_.energy(z_and_gradient_.data())};
    std::tie(powers.of_increment, powers.of_force) =
        products(of_support, dz_.data() + support_.begin, q_.data() + support_.begin, support_.size);
    return powers;
  }
  void update(Vector& z, const Vector& /*f*/, double c, FieldFactors /*before*/, FieldFactors after) const override {
    add_and_damp(z_and_gradient_.data(), dz_.data(), c, q_.data(), after, size_, z.data());
  }

 private:
  // z⁻, in its place.
  void damp(const Vector& z, FieldFactors before) const {
    damp_fields(before, z.data(), size_, z_and_gradient_.data());
  }

  // ẑ from z⁻ and a gradient; |ẑ − z⁻|².
  double move_to_midpoint(Vector& z_mid) const {
    mid_.apply(z_and_gradient_.data(), q_.data());
    return add_and_measure(z_and_gradient_.data() + support_.begin, q_.data(), support_.size,
                           z_mid.data() + support_.begin);
  }

  // From the coordinates of energy, if F and FM lead there.
  void to_state(Vector& v) const {
    if (!in_energy_) return;
    T_.apply(v.data(), y_.data());
    v.head(size_) = y_.head(size_);
  }

  Index size_;
  Potential::Support support_;
  const DenseMetric& metric_;
  Matrix all_F_;
  LaneMatrix F_, FM_, mid_, T_;  // F_: the columns of forces
  double gradient_share_;        // ≥ |Qg|²/|g|² of what ẑ takes from a gradient g
  bool in_energy_;
  mutable Vector z_and_gradient_, dz_, q_, y_;
};

bool is_unit(const Matrix& M, Index i) {
  return M(i, i) == 1 && M.row(i).cwiseAbs().sum() == 1 && M.col(i).cwiseAbs().sum() == 1;
}

}  // namespace

DenseMetric::DenseMetric(const Matrix& M) : size_(M.rows()), leading_(M.rows()) {
  while (leading_ > 0 && is_unit(M, leading_ - 1)) --leading_;
  M_ = LaneMatrix(M.topLeftCorner(leading_, leading_));
  Mz_.resize(M_.padded_rows());
}

double DenseMetric::energy(const double* z) const {
  M_.apply(z, Mz_.data());
  const double *const rest = z + leading_, *const Mz = Mz_.data();
  return with_lanes([ =, leading = leading_, others = size_ - leading_ ]<class V>() __attribute__((always_inline)) {
    return (product_of<V>(z, Mz, leading) + product_of<V>(rest, rest, others)) / 2;
  });
}

std::unique_ptr<Propagator> dense_propagator(const DenseForce& maps, const DenseMetric& metric,
                                             Potential::Support support) {
  return std::make_unique<DensePropagator>(maps, metric, support);
}

}  // namespace seiche
