// φ₀ … φ₃ of the linear part of one mode, φ_j(z) = Σ zⁿ/(n + j)!, for exponential methods.
#pragma once

#include <bench/peers/equation.hpp>
#include <bench/peers/modes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

namespace seiche::bench {

// In long double, since s doublings lose s bits and the stiffest modes here need nearly twenty.
using Real = long double;
using Complex = std::complex<Real>;

struct Matrix2 {
  Real a = 0, b = 0, c = 0, d = 0;  // [[a, b], [c, d]]
};

inline Matrix2 operator+(const Matrix2& x, const Matrix2& y) { return {x.a + y.a, x.b + y.b, x.c + y.c, x.d + y.d}; }
inline Matrix2 operator*(Real s, const Matrix2& x) { return {s * x.a, s * x.b, s * x.c, s * x.d}; }
inline Matrix2 operator*(const Matrix2& x, const Matrix2& y) {
  return {x.a * y.a + x.b * y.c, x.a * y.b + x.b * y.d, x.c * y.a + x.d * y.c, x.c * y.b + x.d * y.d};
}
// The two slots of a pair have one block.
inline bool is_same(const Matrix2& x, const Matrix2& y) { return x.a == y.a && x.b == y.b && x.c == y.c && x.d == y.d; }
inline Real magnitude(const Matrix2& x) {
  return std::max(std::abs(x.a) + std::abs(x.b), std::abs(x.c) + std::abs(x.d));
}
inline Real magnitude(const Complex& x) { return std::abs(x); }
inline Matrix2 identity(const Matrix2&) { return {1, 0, 0, 1}; }
inline Complex identity(const Complex&) { return 1; }

template <class T>
using Phi = std::array<T, 4>;

// Taylor series at z/2ˢ, then φ₂ and φ₃ of 2z from those of z: no cancellation, no inverse.
template <class T>
Phi<T> phi(const T& z) {
  int doublings = 0;
  Real scale = 1;
  for (Real size = magnitude(z); size * scale > Real{0.5}; scale /= 2) ++doublings;
  const T x = scale * z;
  const T one = identity(z);
  Phi<T> p;
  for (int j = 3; j >= 0; --j) {  // Horner, of Σ xⁿ/(n + j)!
    constexpr int terms = 20;
    Real inverse_factorial = 1;
    for (int n = 2; n <= j; ++n) inverse_factorial /= static_cast<Real>(n);
    T sum = one;
    for (int n = terms; n >= 1; --n) sum = one + (1 / static_cast<Real>(n + j)) * (x * sum);
    p[static_cast<std::size_t>(j)] = inverse_factorial * sum;
  }
  for (; doublings > 0; --doublings) {
    const Phi<T> q = p;
    p[3] = Real{0.125} * (q[1] * q[2] + q[2] + Real{2} * q[3]);
    p[2] = Real{0.25} * (q[1] * q[1] + Real{2} * q[2]);
    p[1] = Real{0.5} * (q[0] * q[1] + q[1]);
    p[0] = q[0] * q[0];
  }
  return p;
}

// The linear part of every slot: [[0, 1], [−K, −d]] of second-order equations …
std::vector<Matrix2> wave_blocks(const Equation& equation, const Symbols& symbols);
// … and scalar_symbol of the others, once per pair of slots.
std::vector<Complex> scalar_blocks(const Equation& equation, const Symbols& symbols);

// e^{hA} on (û, v̂), slot by slot.
class WaveFlow {
 public:
  WaveFlow(const std::vector<Matrix2>& blocks, double h);
  void apply(double* u, double* v) const;

 private:
  std::vector<double> a_, b_, c_, d_;
};

}  // namespace seiche::bench
