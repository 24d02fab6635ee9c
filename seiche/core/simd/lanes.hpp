// Eight numbers that are computed together, in the widest registers of an instruction set. Plain C++ of GCC and Clang.
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>

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

// How many times eight numbers so many are, the last time perhaps not all of them, and how many that makes.
template <class Integer>
constexpr Integer groups_of_lanes(Integer count) {
  return (count + lane_count - 1) / lane_count;
}
template <class Integer>
constexpr Integer whole_lanes(Integer count) {
  return groups_of_lanes(count) * lane_count;
}

// A vector that is wider than the registers there are is computed through the stack, by up to four times as many
// instructions. Hence it is two of half its width, down to those that fit.
template <class Half>
struct TwoOf {
  Half low, high;

  [[gnu::always_inline]] friend inline TwoOf operator+(const TwoOf& x, const TwoOf& y) {
    return {x.low + y.low, x.high + y.high};
  }
  [[gnu::always_inline]] friend inline TwoOf operator-(const TwoOf& x, const TwoOf& y) {
    return {x.low - y.low, x.high - y.high};
  }
  [[gnu::always_inline]] friend inline TwoOf operator*(const TwoOf& x, const TwoOf& y) {
    return {x.low * y.low, x.high * y.high};
  }
  [[gnu::always_inline]] friend inline TwoOf operator/(const TwoOf& x, const TwoOf& y) {
    return {x.low / y.low, x.high / y.high};
  }
  [[gnu::always_inline]] friend inline TwoOf operator+(const TwoOf& x, double y) { return {x.low + y, x.high + y}; }
  [[gnu::always_inline]] friend inline TwoOf operator*(double x, const TwoOf& y) { return {x * y.low, x * y.high}; }
  [[gnu::always_inline]] friend inline TwoOf operator/(double x, const TwoOf& y) { return {x / y.low, x / y.high}; }
  [[gnu::always_inline]] inline TwoOf& operator+=(const TwoOf& y) { return *this = *this + y; }
};

using LanesInQuarters = TwoOf<TwoOf<Pair>>;
using LanesInHalves = TwoOf<HalfLanes>;

template <class V>
inline constexpr bool is_in_parts = false;
template <class Half>
inline constexpr bool is_in_parts<TwoOf<Half>> = true;

// What is half as wide.
template <class V>
struct HalfOf;
template <>
struct HalfOf<Lanes> {
  using type = HalfLanes;
};
template <class Half>
struct HalfOf<TwoOf<Half>> {
  using type = Half;
};
template <>
struct HalfOf<HalfLanes> {
  using type = Pair;
};

// body(j, V{}) for eight numbers from j on at a time, then the same with HalfOf<V> for four, with its half for two, and
// with 0.0 for one.
template <class V, class Body>
[[gnu::always_inline]] inline void for_lanes(std::ptrdiff_t begin, std::ptrdiff_t end, const Body& body) {
  using Half = typename HalfOf<V>::type;
  std::ptrdiff_t j = begin;
  for (; j + lane_count <= end; j += lane_count) body(j, V{});
  if (j + 4 <= end) {
    body(j, Half{});
    j += 4;
  }
  if (j + 2 <= end) {
    body(j, typename HalfOf<Half>::type{});
    j += 2;
  }
  if (j < end) body(j, 0.0);
}

// Always inlined, so that they are compiled for the instruction set of the loop around them. Part by part: what is
// copied as a whole goes through the stack.
template <class V>
[[gnu::always_inline]] inline V load(const double* p) {
  if constexpr (is_in_parts<V>) {
    using Half = decltype(V::low);
    return {load<Half>(p), load<Half>(p + sizeof(Half) / sizeof(double))};
  } else {
    V v;
    std::memcpy(&v, p, sizeof v);
    return v;
  }
}

template <class V>
[[gnu::always_inline]] inline void store(double* p, const V& v) {
  if constexpr (is_in_parts<V>) {
    store(p, v.low);
    store(p + sizeof(v.low) / sizeof(double), v.high);
  } else {
    std::memcpy(p, &v, sizeof v);
  }
}

// The halves of V, and V of them.
template <class V>
[[gnu::always_inline]] inline typename HalfOf<V>::type low_half(const V& x) {
  if constexpr (is_in_parts<V>)
    return x.low;
  else if constexpr (sizeof(V) == sizeof(Lanes))
    return __builtin_shufflevector(x, x, 0, 1, 2, 3);
  else
    return __builtin_shufflevector(x, x, 0, 1);
}
template <class V>
[[gnu::always_inline]] inline typename HalfOf<V>::type high_half(const V& x) {
  if constexpr (is_in_parts<V>)
    return x.high;
  else if constexpr (sizeof(V) == sizeof(Lanes))
    return __builtin_shufflevector(x, x, 4, 5, 6, 7);
  else
    return __builtin_shufflevector(x, x, 2, 3);
}
template <class V>
[[gnu::always_inline]] inline V joined(const typename HalfOf<V>::type& low, const typename HalfOf<V>::type& high) {
  if constexpr (is_in_parts<V>)
    return {low, high};
  else if constexpr (sizeof(V) == sizeof(Lanes))
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
  else
    return __builtin_shufflevector(low, high, 0, 1, 2, 3);
}

[[gnu::always_inline]] inline double absolute(double x) { return __builtin_fabs(x); }
template <class V>
[[gnu::always_inline]] inline V absolute(const V& x) {
  if constexpr (is_in_parts<V>)
    return {absolute(x.low), absolute(x.high)};
  else
    return x < 0.0 ? -x : x;
}

// x₁ x₀ x₃ x₂ …
template <class V>
[[gnu::always_inline]] inline V with_pairs_turned(const V& x) {
  if constexpr (is_in_parts<V>)
    return {with_pairs_turned(x.low), with_pairs_turned(x.high)};
  else if constexpr (sizeof(V) == sizeof(Lanes))
    return __builtin_shufflevector(x, x, 1, 0, 3, 2, 5, 4, 7, 6);
  else if constexpr (sizeof(V) == sizeof(HalfLanes))
    return __builtin_shufflevector(x, x, 1, 0, 3, 2);
  else
    return __builtin_shufflevector(x, x, 1, 0);
}

// x₀ x₀ x₂ x₂ …, or x₁ x₁ x₃ x₃ …
template <int which, class V>
[[gnu::always_inline]] inline V of_pairs(const V& x) {
  if constexpr (is_in_parts<V>)
    return {of_pairs<which>(x.low), of_pairs<which>(x.high)};
  else if constexpr (sizeof(V) == sizeof(Lanes))
    return __builtin_shufflevector(x, x, which, which, 2 + which, 2 + which, 4 + which, 4 + which, 6 + which,
                                   6 + which);
  else if constexpr (sizeof(V) == sizeof(HalfLanes))
    return __builtin_shufflevector(x, x, which, which, 2 + which, 2 + which);
  else
    return __builtin_shufflevector(x, x, which, which);
}

// p₀ p₀ p₁ p₁ … from memory
template <class V>
[[gnu::always_inline]] inline V load_twice(const double* p) {
  if constexpr (is_in_parts<V>) {
    using Half = decltype(V::low);
    return {load_twice<Half>(p), load_twice<Half>(p + sizeof(Half) / sizeof(Pair))};
  } else if constexpr (sizeof(V) == sizeof(Lanes)) {
    const auto c = load<HalfLanes>(p);
    return __builtin_shufflevector(c, c, 0, 0, 1, 1, 2, 2, 3, 3);
  } else if constexpr (sizeof(V) == sizeof(HalfLanes)) {
    const auto c = load<Pair>(p);
    return __builtin_shufflevector(c, c, 0, 0, 1, 1);
  } else {
    return Pair{p[0], p[0]};
  }
}

// −x₀ x₁ −x₂ x₃ …
template <class V>
[[gnu::always_inline]] inline V with_first_negated(const V& x) {
  if constexpr (is_in_parts<V>)
    return {with_first_negated(x.low), with_first_negated(x.high)};
  else if constexpr (sizeof(V) == sizeof(Lanes))
    return x * V{-1, 1, -1, 1, -1, 1, -1, 1};
  else if constexpr (sizeof(V) == sizeof(HalfLanes))
    return x * V{-1, 1, -1, 1};
  else
    return x * V{-1, 1};
}

template <class V>
[[gnu::always_inline]] inline double last_of(const V& x) {
  if constexpr (is_in_parts<V>)
    return last_of(x.high);
  else
    return x[sizeof(V) / sizeof(double) - 1];
}

// The last of `before`, and then x but for its last.
template <class V>
[[gnu::always_inline]] inline V shifted(const V& before, const V& x) {
  if constexpr (is_in_parts<V>)
    return {shifted(before.high, x.low), shifted(x.low, x.high)};
  else if constexpr (sizeof(V) == sizeof(Lanes))
    return __builtin_shufflevector(before, x, 7, 8, 9, 10, 11, 12, 13, 14);
  else if constexpr (sizeof(V) == sizeof(HalfLanes))
    return __builtin_shufflevector(before, x, 3, 4, 5, 6);
  else
    return __builtin_shufflevector(before, x, 1, 2);
}

// In one fixed order, whatever the instruction set.
[[gnu::always_inline]] inline double sum(double v) { return v; }
[[gnu::always_inline]] inline double sum(const Pair& v) { return v[0] + v[1]; }
template <class V>
[[gnu::always_inline]] inline double sum(const V& v) {
  return sum(low_half(v) + high_half(v));
}

// Σ_j f(j) over [begin, end), with f as the body of for_lanes.
template <class V, class F>
[[gnu::always_inline]] inline double sum_lanes(std::ptrdiff_t begin, std::ptrdiff_t end, const F& f) {
  using Half = typename HalfOf<V>::type;
  V sums{};
  Half half{};
  typename HalfOf<Half>::type pair{};
  double rest = 0;
  for_lanes<V>(
      begin, end, [&]<class X>(std::ptrdiff_t j, const X& lanes) __attribute__((always_inline)) {
        if constexpr (std::is_same_v<X, V>)
          sums += f(j, lanes);
        else if constexpr (std::is_same_v<X, Half>)
          half = f(j, lanes);
        else if constexpr (std::is_same_v<X, double>)
          rest = f(j, lanes);
        else
          pair = f(j, lanes);
      });
  half += low_half(sums) + high_half(sums);
  pair += low_half(half) + high_half(half);
  return sum(pair) + rest;
}

}  // namespace seiche
