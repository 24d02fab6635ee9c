// W(u) = Σ c_i uⁱ of one variable: value, slope, and the mean slope between two points without cancellation.
#pragma once

#include <seiche/core/simd/lanes.hpp>

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>

namespace seiche {

// What a potential per point (or per bond) must tell. Inlined into loops over the grid.
template <class W>
concept PointPotential = requires(const W w, double u) {
  { w.value(u) } -> std::convertible_to<double>;
  { w.slope(u) } -> std::convertible_to<double>;
  { w.mean_slope(u, u) } -> std::convertible_to<double>;  // ∫₀¹ W'(a + s(b − a)) ds
  { w.grows_outward() } -> std::convertible_to<bool>;     // u W'(u) ≥ 0 for all u
};

// Of degree Most up to `most_exact`; above it of degree `last` ≤ Most, with zeros behind. Of Lanes: eight polynomials.
template <int Most, class Number = double>
struct Polynomial {
  static constexpr int most = Most;
  static constexpr int most_exact = 6;
  std::array<Number, Most + 1> c{};
  int last = Most;  // the coefficients behind this one are zero

  int degree() const {
    if constexpr (Most <= most_exact) return Most;
    return last;
  }

  // Of one number, or of Lanes.
  template <class X>
  [[gnu::always_inline]] X value(const X& u) const {
    X sum = X{} + c[Most];
    for (std::size_t i = Most; i-- > 0;) sum = sum * u + c[i];
    return sum;
  }

  // Σ|c_i uⁱ|: what round-off in the value is a fraction of, also where the terms cancel.
  template <class X>
  [[gnu::always_inline]] X size(const X& u) const {
    X sum = X{} + absolute(c[Most]);
    for (std::size_t i = Most; i-- > 0;) sum = sum * absolute(u) + absolute(c[i]);
    return sum;
  }

  template <class X>
  [[gnu::always_inline]] X slope(const X& u) const {
    X sum = X{} + Most * c[Most];
    for (std::size_t i = Most; i-- > 1;) sum = sum * u + static_cast<double>(i) * c[i];
    return sum;
  }

  // (W(b) − W(a)) / (b − a): divide by (u − a) with Horner's rule and evaluate the quotient at b.
  template <class X>
  [[gnu::always_inline]] X mean_slope(const X& a, const X& b) const {
    X quotient = X{} + c[Most];
    X sum = quotient;
    for (std::size_t i = Most; i-- > 1;) {
      quotient = a * quotient + c[i];
      sum = sum * b + quotient;
    }
    return sum;
  }

  // Coefficients of x ↦ W(p + xq), added to `out`: Taylor's shift by repeated division, then powers of q.
  void add_along(double p, double q, double* out) const {
    std::array<double, Most + 1> taylor = c;
    const auto n = static_cast<std::size_t>(degree());
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = n; i-- > k;) taylor[i] += p * taylor[i + 1];
    double power = 1;
    for (std::size_t i = 0; i <= n; ++i) {
      out[i] += taylor[i] * power;
      power *= q;
    }
  }

  // The only power there is, or 0.
  int homogeneity() const {
    int power = 0;
    for (int i = 0; i <= Most; ++i) {
      if (c[static_cast<std::size_t>(i)] == 0) continue;
      if (power != 0 || i == 0) return 0;
      power = i;
    }
    return power;
  }

  bool grows_outward() const {
    for (std::size_t i = 1; i <= Most; ++i)
      if (c[i] < 0 || (i % 2 == 1 && c[i] != 0)) return false;
    return true;
  }
};

template <class W>
concept IsPolynomial = requires(const W w) {
  w.degree();
};

// 0 for what is not a polynomial.
template <PointPotential W>
int homogeneity_of(const W& w) {
  if constexpr (requires { w.homogeneity(); }) return w.homogeneity();
  return 0;
}

}  // namespace seiche
