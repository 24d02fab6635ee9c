// Eight small square matrices at a time, one in each lane, for loops that are compiled for several instruction sets.
#pragma once

#include <seiche/core/simd/lanes.hpp>

#include <array>
#include <cstddef>
#include <type_traits>

namespace seiche {

// Eight complex numbers.
struct ComplexLanes {
  Lanes re{}, im{};
};

[[gnu::always_inline]] inline ComplexLanes operator+(const ComplexLanes& a, const ComplexLanes& b) {
  return {a.re + b.re, a.im + b.im};
}
[[gnu::always_inline]] inline ComplexLanes operator-(const ComplexLanes& a, const ComplexLanes& b) {
  return {a.re - b.re, a.im - b.im};
}
[[gnu::always_inline]] inline ComplexLanes operator*(const ComplexLanes& a, const ComplexLanes& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
[[gnu::always_inline]] inline ComplexLanes operator*(const Lanes& a, const ComplexLanes& b) {
  return {a * b.re, a * b.im};
}
[[gnu::always_inline]] inline Lanes conjugate(const Lanes& a) { return a; }
[[gnu::always_inline]] inline ComplexLanes conjugate(const ComplexLanes& a) { return {a.re, -a.im}; }

using LaneMask = decltype(Lanes{} < Lanes{});

[[gnu::always_inline]] inline Lanes choose(const LaneMask& mask, const Lanes& a, const Lanes& b) {
  return mask ? a : b;
}
[[gnu::always_inline]] inline ComplexLanes choose(const LaneMask& mask, const ComplexLanes& a, const ComplexLanes& b) {
  return {choose(mask, a.re, b.re), choose(mask, a.im, b.im)};
}

[[gnu::always_inline]] inline Lanes all_lanes(double x) { return Lanes{} + x; }

// m × m, entry (i, j) at [i * m + j]; Scalar: Lanes or ComplexLanes.
template <class Scalar, int m>
struct ModeBlock {
  std::array<Scalar, static_cast<std::size_t>(m* m)> entries{};

  [[gnu::always_inline]] inline Scalar& operator()(int i, int j) { return entries[i * m + j]; }
  [[gnu::always_inline]] inline const Scalar& operator()(int i, int j) const { return entries[i * m + j]; }
  [[gnu::always_inline]] inline void add_to_diagonal(const Lanes& x) {
    for (int i = 0; i < m; ++i) {
      if constexpr (std::is_same_v<Scalar, Lanes>)
        (*this)(i, i) += x;
      else
        (*this)(i, i).re += x;
    }
  }
};

template <class Scalar, int m>
[[gnu::always_inline]] inline ModeBlock<Scalar, m> operator*(const ModeBlock<Scalar, m>& a,
                                                             const ModeBlock<Scalar, m>& b) {
  ModeBlock<Scalar, m> c;
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < m; ++j) {
      Scalar sum = a(i, 0) * b(0, j);
      for (int k = 1; k < m; ++k) sum = sum + a(i, k) * b(k, j);
      c(i, j) = sum;
    }
  }
  return c;
}

template <class Scalar, int m>
[[gnu::always_inline]] inline ModeBlock<Scalar, m> operator*(const Lanes& a, const ModeBlock<Scalar, m>& b) {
  ModeBlock<Scalar, m> c;
  for (int i = 0; i < m * m; ++i) c.entries[i] = a * b.entries[i];
  return c;
}

// a += x b
template <class Scalar, int m>
[[gnu::always_inline]] inline void add_scaled(const Lanes& x, const ModeBlock<Scalar, m>& b, ModeBlock<Scalar, m>& a) {
  for (int i = 0; i < m * m; ++i) a.entries[i] = a.entries[i] + x * b.entries[i];
}

}  // namespace seiche
