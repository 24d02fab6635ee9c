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

// The two maps of a substep into the coordinates that a state has; T = 1 where the others lead there themselves.
struct Substep {
  LaneMatrix::View FM, F, T;
  double *dz, *q, *in_energy;
  Index size;

  template <class V>
  [[gnu::always_inline]] inline void apply(const double* z, const double* f) const {
    FM.apply<V>(z, dz);
    F.apply<V>(f, q);
    for (double* v : {dz, q}) to_state<V>(v);
  }
  template <class V>
  [[gnu::always_inline]] inline void to_state(double* v) const {
    if (T.rows == 0) return;
    T.apply<V>(v, in_energy);
    std::copy_n(in_energy, size, v);
  }
};

// ẑ = z⁻ + Q(Mz⁻ + ∇V) on the support, as one matrix times (z⁻, ∇V).
struct Midpoint {
  LaneMatrix::View map;
  double *z, *gradient, *move;  // the gradient behind z⁻
  Index size;
  Potential::Support support;

  // |ẑ − z⁻|²
  template <class V>
  [[gnu::always_inline]] inline double apply(double* z_mid) const {
    map.apply<V>(z, move);
    return add_and_measure<V>(z + support.begin, move, support.size, z_mid);
  }
};

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

  void predict(const Vector& z, const Vector& gradient, Vector& z_mid, FieldFactors before) const override {
    with_lanes([ =, mid = midpoint(), from = z.data(), g = of_support(gradient),
                 out = z_mid.data() + support_.begin ]<class V>() __attribute__((always_inline)) {
      damp_fields<V>(before, from, mid.size, mid.z);
      std::copy_n(g, mid.support.size, mid.gradient);
      mid.template apply<V>(out);
    });
  }
  bool recall(const Vector& z, const Gradients& g, Vector& z_mid, FieldFactors before,
              Recalled& recalled) const override {
    with_lanes([
      =, mid = midpoint(), from = z.data(), g0 = of_support(g.g0), g1 = of_support(g.g1), g2 = of_support(g.g2), g = &g,
      out = z_mid.data() + support_.begin, to = &recalled
    ]<class V>() __attribute__((always_inline)) {
      damp_fields<V>(before, from, mid.size, mid.z);
      to->missed = extrapolate<V>(g0, g1, g2, g->weight, g->ratio, mid.support.size, mid.gradient);
      to->moved = mid.template apply<V>(out);
    });
    recalled.missed *= gradient_share_;
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

  Powers powers(const Vector& z, const Vector& f, FieldFactors before) const override {
    return with_lanes([
      =, n = support_.size, begin = support_.begin, from = z.data(), g = of_support(f), x = z_and_gradient_.data(),
      metric = metric_.view(), substep = substep()
    ]<class V>() __attribute__((always_inline)) {
      damp_fields<V>(before, from, substep.size, x);
      substep.template apply<V>(x, g);
      return Powers{product_of<V>(g, substep.dz + begin, n), product_of<V>(g, substep.q + begin, n),
                    metric.template energy<V>(x)};
    });
  }
  void update(Vector& z, const Vector& /*f*/, double c, FieldFactors /*before*/, FieldFactors after) const override {
    with_lanes(
        [ =, size = size_, x = z_and_gradient_.data(), dz = dz_.data(), q = q_.data(), out = z.data() ]<class V>()
            __attribute__((always_inline)) { add_and_damp<V>(x, dz, c, q, after, size, out); });
  }

 private:
  const double* of_support(const Vector& v) const { return v.data() + support_.begin; }
  Midpoint midpoint() const {
    double* const z = z_and_gradient_.data();
    return {mid_.view(), z, z + size_, q_.data(), size_, support_};
  }
  Substep substep() const { return {FM_.view(), F_.view(), T_.view(), dz_.data(), q_.data(), y_.data(), size_}; }

  // From the coordinates of energy, if F and FM lead there.
  void to_state(Vector& v) const {
    with_lanes([ substep = substep(), v = v.data() ]<class V>()
                   __attribute__((always_inline)) { substep.template to_state<V>(v); });
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
