#include <seiche/backend/dense/dense_propagator.hpp>
#include <seiche/core/numerics/norm_bound.hpp>
#include <seiche/core/simd/with_lanes.hpp>

#include <algorithm>

namespace seiche {
namespace {

using Matrix = Eigen::MatrixXd;

// visit(begin, end, factor) for each field of so many numbers.
template <class Visit>
[[gnu::always_inline]] inline void for_fields(Propagator::FieldFactors factors, Index size, const Visit& visit) {
  if (factors.empty()) return visit(Index{0}, size, 1.0);
  const Index fields = std::ssize(factors);
  const Index slots = fields == 1 ? size : fields == 2 ? size / 2 : size / fields;  // divisions are slow
  for (Index f = 0; f < fields; ++f) visit(f * slots, (f + 1) * slots, factors[static_cast<std::size_t>(f)]);
}

template <class V>
[[gnu::always_inline]] inline double product_of(const double* x, const double* y, Index n) {
  return sum_lanes<V>(
      0,
      n, [=]<class X>(Index j, const X&) __attribute__((always_inline)) { return X(load<X>(x + j) * load<X>(y + j)); });
}

// z⁻ = Λz
template <class V>
[[gnu::always_inline]] inline void damp_fields(Propagator::FieldFactors factors, const double* z, Index size,
                                               double* damped) {
  for_fields(
      factors, size, [=](Index begin, Index end, double factor) __attribute__((always_inline)) {
        for_lanes<V>(
            begin, end, [=]<class X>(Index j, const X&) __attribute__((always_inline)) {
              store<X>(damped + j, factor * load<X>(z + j));
            });
      });
}

// Λ'(z + dz + c q)
template <class V>
[[gnu::always_inline]] inline void add_and_damp(const double* z, const double* dz, double c, const double* q,
                                                Propagator::FieldFactors factors, Index size, double* out) {
  for_fields(
      factors, size, [=](Index begin, Index end, double factor) __attribute__((always_inline)) {
        for_lanes<V>(
            begin, end, [=]<class X>(Index j, const X&) __attribute__((always_inline)) {
              store<X>(out + j, factor * (load<X>(z + j) + load<X>(dz + j) + c * load<X>(q + j)));
            });
      });
}

// sum = a + b; |b|²
template <class V>
[[gnu::always_inline]] inline double add_and_measure(const double* a, const double* b, Index n, double* sum) {
  return sum_lanes<V>(
      0, n, [=]<class X>(Index j, const X&) __attribute__((always_inline)) {
        const X added = load<X>(b + j);
        store<X>(sum + j, load<X>(a + j) + added);
        return X(added * added);
      });
}

// next = g₀ + weight·(g₀ − g₁); |g₀ − g₁ − ratio·(g₁ − g₂)|²
template <class V>
[[gnu::always_inline]] inline double extrapolate(const double* g0, const double* g1, const double* g2, double weight,
                                                 double ratio, Index n, double* next) {
  return sum_lanes<V>(
      0, n, [=]<class X>(Index j, const X&) __attribute__((always_inline)) {
        const X newest = load<X>(g0 + j), last = load<X>(g1 + j), change = newest - last;
        store<X>(next + j, newest + weight * change);
        const X second = change - ratio * (last - load<X>(g2 + j));
        return X(second * second);
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
    z_.resize(size_ + support.size);
    y_.resize(T_.padded_rows());
    for (Vector* v : {&dz_, &q_}) v->resize(std::max(FM_.padded_rows(), mid_.padded_rows()));
  }

  void predict(const Vector& z, const Vector& gradient, Vector& z_mid, FieldFactors before) const override {
    with_lanes([ =, this, z = z.data(), g = of_support(gradient), out = of_support(z_mid) ]<class V>()
                   __attribute__((always_inline)) {
                     damp_fields<V>(before, z, size_, z_.data());
                     std::copy_n(g, support_.size, z_.data() + size_);
                     to_middle<V>(out);
                   });
  }
  bool recall(const Vector& z, const Gradients& g, Vector& z_mid, FieldFactors before,
              Recalled& recalled) const override {
    with_lanes([ =, this, z = z.data(), g = &g, out = of_support(z_mid), to = &
                 recalled ]<class V>() __attribute__((always_inline)) {
      damp_fields<V>(before, z, size_, z_.data());
      to->missed = gradient_share_ * extrapolate<V>(of_support(g->g0), of_support(g->g1), of_support(g->g2), g->weight,
                                                    g->ratio, support_.size, z_.data() + size_);
      to->moved = to_middle<V>(out);
    });
    recalled.missed_is_rough = true;
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

  Powers powers(const Vector& /*z*/, const Vector& f, FieldFactors /*before*/) const override {
    return with_lanes([ this, f = of_support(f) ]<class V>() __attribute__((always_inline)) {
      const Index n = support_.size, begin = support_.begin;
      double *const damped = z_.data(), *const dz = dz_.data(), *const q = q_.data();
      FM_.view().template apply<V>(damped, dz);
      F_.view().template apply<V>(f, q);
      to_state<V>(dz);
      to_state<V>(q);
      return Powers{product_of<V>(f, dz + begin, n), product_of<V>(f, q + begin, n),
                    metric_.view().template energy<V>(damped)};
    });
  }
  void update(Vector& z, const Vector& /*f*/, double c, FieldFactors /*before*/, FieldFactors after) const override {
    with_lanes([ =, this, z = z.data() ]<class V>() __attribute__((always_inline)) {
      add_and_damp<V>(z_.data(), dz_.data(), c, q_.data(), after, size_, z);
    });
  }

 private:
  const double* of_support(const Vector& v) const { return v.data() + support_.begin; }
  double* of_support(Vector& v) const { return v.data() + support_.begin; }

  // ẑ = z⁻ + Q(Mz⁻ + ∇V) on the support, as one matrix times (z⁻, ∇V) in z_. Returns |ẑ − z⁻|².
  template <class V>
  [[gnu::always_inline]] inline double to_middle(double* z_mid) const {
    mid_.view().template apply<V>(z_.data(), q_.data());
    return add_and_measure<V>(of_support(z_), q_.data(), support_.size, z_mid);
  }

  // From the coordinates of energy, if F and FM lead there.
  template <class V>
  [[gnu::always_inline]] inline void to_state(double* v) const {
    if (!in_energy_) return;
    T_.view().template apply<V>(v, y_.data());
    std::copy_n(y_.data(), size_, v);
  }
  void to_state(Vector& v) const {
    with_lanes([ this, v = v.data() ]<class V>() __attribute__((always_inline)) { to_state<V>(v); });
  }

  Index size_;
  Potential::Support support_;
  const DenseMetric& metric_;
  Matrix all_F_;
  LaneMatrix F_, FM_, mid_, T_;  // F_: the columns of forces
  double gradient_share_;        // ≥ |Qg|²/|g|² of what ẑ takes from a gradient g
  bool in_energy_;
  mutable Vector z_, dz_, q_, y_;  // z⁻ with a gradient behind it, FMz⁻, Ff
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

template <class V>
[[gnu::always_inline]] inline double DenseMetric::View::energy(const double* z) const {
  M.apply<V>(z, Mz);
  return (product_of<V>(z, Mz, M.columns) + product_of<V>(z + M.columns, z + M.columns, size - M.columns)) / 2;
}

double DenseMetric::energy(const double* z) const {
  return with_lanes([ metric = view(), z ]<class V>()
                        __attribute__((always_inline)) { return metric.template energy<V>(z); });
}

std::unique_ptr<Propagator> dense_propagator(const DenseForce& maps, const DenseMetric& metric,
                                             Potential::Support support) {
  return std::make_unique<DensePropagator>(maps, metric, support);
}

}  // namespace seiche
