// Eight numbers that are computed together: one AVX-512 register, two of AVX2, four of SSE2. Plain C++ of GCC and
// Clang.
#pragma once

#include <cstring>

// Lanes never cross a call that is not inlined.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace seiche {

using Lanes =
    double __attribute__((vector_size(64)));  // NOLINT(modernize-use-using): the attribute belongs to the type
using HalfLanes = double __attribute__((vector_size(32)));
using Pair = double __attribute__((vector_size(16)));
inline constexpr int lane_count = 8;

// Always inlined, so that they are compiled for the instruction set of the loop around them.
template <class V>
[[gnu::always_inline]] inline V load(const double* p) {
  V v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

template <class V>
[[gnu::always_inline]] inline void store(double* p, const V& v) {
  std::memcpy(p, &v, sizeof v);
}

// In one fixed order, whatever the instruction set.
[[gnu::always_inline]] inline double sum(const Lanes& v) {
  return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}
[[gnu::always_inline]] inline double sum(const Pair& v) { return v[0] + v[1]; }
[[gnu::always_inline]] inline double sum(double v) { return v; }

}  // namespace seiche
