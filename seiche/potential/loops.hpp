// Loops over the points of a grid: eight points at a time, for several instruction sets, sums in one fixed order.
#pragma once

#include <seiche/core/base/vector.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/core/simd/long_sum.hpp>
#include <seiche/core/simd/multiversion.hpp>
#include <seiche/core/simd/with_lanes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>

namespace seiche {

// W can be evaluated at eight points at a time.
template <class W>
concept TakesLanes = requires(const W w, Lanes u) {
  { w.value(u) } -> std::same_as<Lanes>;
  { w.slope(u) } -> std::same_as<Lanes>;
};

// Its mean slopes too.
template <class W>
concept HasMeansOfLanes = TakesLanes<W> && requires(const W w, Lanes u) {
  { w.mean_slope(u, u) } -> std::same_as<Lanes>;
};

// W is made of elementary functions, and evaluated at a block of points by vector functions.
template <class W>
concept TakesBlocks = requires(const W w, const double* u, double* out, std::size_t n) {
  w.values(u, out, n);
  w.values_and_slopes(u, out, out, n);
  w.values_and_sizes(u, out, out, n);
  w.mean_slopes(u, u, out, out, n);
};

// Numbers of one block, for what is computed on the way.
using BlockOfPoints = std::array<double, LongSum::block>;

// Sums that do not wait for one another.
class LaneSums {
 public:
  double& operator[](std::size_t lane) { return sums_[lane]; }
  double total() const {
    return ((sums_[0] + sums_[4]) + (sums_[2] + sums_[6])) + ((sums_[1] + sums_[5]) + (sums_[3] + sums_[7]));
  }

 private:
  std::array<double, 8> sums_{};
};

// visit(j, lane) for the points from `begin` on, where `lane` is the one of LaneSums that its number goes to.
template <class Visit>
[[gnu::always_inline]] inline void for_points(std::size_t begin, std::size_t end, const Visit& visit) {
  std::size_t j = begin;
  for (; j + 8 <= end; j += 8)
    for (std::size_t lane = 0; lane < 8; ++lane) visit(j + lane, lane);
  for (std::size_t lane = 0; j < end; ++j, ++lane) visit(j, lane);
}

// visit(begin, end) for each block of a long sum.
template <class Visit>
[[gnu::always_inline]] inline void for_blocks(std::size_t n, const Visit& visit) {
  for (std::size_t begin = 0; begin < n; begin += LongSum::block) visit(begin, std::min(begin + LongSum::block, n));
}

// Σ_j f(j), where f may write to place j.
template <class F>
[[gnu::always_inline]] inline double sum_points(std::size_t n, const F& f) {
  LongSum all;
  for_blocks(
      n, [&](std::size_t begin, std::size_t end) __attribute__((always_inline)) {
        LaneSums sums;
        for_points(begin, end, [&](std::size_t j, std::size_t lane) { sums[lane] += f(j); });
        all.add(sums.total());
      });
  return all.total();
}

// Σ_j f(j) and Σ_j size(j, f(j)).
template <class F, class Size>
[[gnu::always_inline]] inline ValueAndMagnitude sum_points_and_sizes(std::size_t n, const F& f, const Size& size) {
  LongSum values, magnitudes;
  for_blocks(
      n, [&](std::size_t begin, std::size_t end) __attribute__((always_inline)) {
        LaneSums of_block, sizes;
        for_points(begin, end, [&](std::size_t j, std::size_t lane) {
          const double value = f(j);
          of_block[lane] += value;
          sizes[lane] += size(j, value);
        });
        values.add(of_block.total());
        magnitudes.add(sizes.total());
      });
  return {values.total(), magnitudes.total()};
}

// coefficients[k] ← Σ_j of what add(j, into) adds to into[k].
template <class Add>
void sum_coefficients(std::size_t n, std::span<double> coefficients, const Add& add) {
  constexpr std::size_t most = 65;  // degree 64, the highest of a single field
  if (coefficients.size() > most) {
    std::fill(coefficients.begin(), coefficients.end(), 0.0);
    for (std::size_t j = 0; j < n; ++j) add(j, coefficients.data());
    return;
  }
  std::array<LongSum, most> all{};
  std::array<double, most> of_block{};
  constexpr std::size_t block = LongSum::block / lane_count;  // one after the other here
  for (std::size_t begin = 0; begin < n; begin += block) {
    std::fill_n(of_block.begin(), coefficients.size(), 0.0);
    for (std::size_t j = begin; j < std::min(begin + block, n); ++j) add(j, of_block.data());
    for (std::size_t k = 0; k < coefficients.size(); ++k) all[k].add(of_block[k]);
  }
  for (std::size_t k = 0; k < coefficients.size(); ++k) coefficients[k] = all[k].total();
}

// The size of the terms of W(u), with u W'(u) where that is not of their size; or |W(u)| where they are not known.
template <class W>
[[gnu::always_inline]] inline double size_of(const W& w, double u, double value) {
  if constexpr (requires { w.size(u); }) return w.size(u);
  return std::abs(value);
}

// Σ_j f(j) by f(j, V{}) for the eight numbers from j on, and fewer of them for the last few.
template <class W, class V, class F>
[[gnu::always_inline]] inline double sum_points_in_lanes(std::size_t n, const F& f) {
  if constexpr (TakesLanes<W>) {
    if (n <= LongSum::block) return sum_lanes<V>(0, static_cast<Index>(n), f);
    LongSum all;
    for_blocks(
        n, [&](std::size_t begin, std::size_t end) __attribute__((always_inline)) {
          all.add(sum_lanes<V>(static_cast<Index>(begin), static_cast<Index>(end), f));
        });
    return all.total();
  } else {
    return sum_points(
        n, [&](std::size_t j) __attribute__((always_inline)) { return f(static_cast<Index>(j), 0.0); });
  }
}

// Σ_j of the numbers that compute(begin, count, into) puts into the blocks.
template <class Compute>
[[gnu::always_inline]] inline double sum_blocks(std::size_t n, const Compute& compute) {
  BlockOfPoints of_block;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before it is read
  LongSum all;
  for_blocks(
      n, [&](std::size_t begin, std::size_t end) __attribute__((always_inline)) {
        compute(begin, end - begin, of_block.data());
        LaneSums sums;
        for_points(0, end - begin, [&](std::size_t j, std::size_t lane) { sums[lane] += of_block[j]; });
        all.add(sums.total());
      });
  return all.total();
}

template <class W>
double sum_values(const W& w, const double* u, std::size_t n) {
  return with_lanes([=]<class V>() __attribute__((always_inline)) {
    if constexpr (TakesBlocks<W>)
      return sum_blocks(
          n, [=](std::size_t begin, std::size_t count, double* values)
                 __attribute__((always_inline)) { w.values(u + begin, values, count); });
    return sum_points_in_lanes<W, V>(
        n, [=]<class X>(Index j, const X&) __attribute__((always_inline)) { return w.value(load<X>(u + j)); });
  });
}

template <class W>
SEICHE_MULTIVERSION ValueAndMagnitude sum_values_and_magnitudes(const W& w, const double* u, std::size_t n) {
  const W local = w;
  if constexpr (TakesBlocks<W>) {
    LongSum sizes;
    BlockOfPoints of_block;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before it is read
    const double value = sum_blocks(
        n, [&](std::size_t begin, std::size_t count, double* values) __attribute__((always_inline)) {
          local.values_and_sizes(u + begin, values, of_block.data(), count);
          LaneSums sums;
          for_points(0, count, [&](std::size_t j, std::size_t lane) { sums[lane] += of_block[j]; });
          sizes.add(sums.total());
        });
    return {value, sizes.total()};
  }
  return sum_points_and_sizes(
      n, [&](std::size_t j) __attribute__((always_inline)) { return local.value(u[j]); },
      [&](std::size_t j, double value) __attribute__((always_inline)) { return size_of(local, u[j], value); });
}

template <class W>
double sum_values_and_slopes(const W& w, const double* u, double* slope, std::size_t n) {
  return with_lanes([=]<class V>() __attribute__((always_inline)) {
    if constexpr (TakesBlocks<W>)
      return sum_blocks(
          n, [=](std::size_t begin, std::size_t count, double* values)
                 __attribute__((always_inline)) { w.values_and_slopes(u + begin, values, slope + begin, count); });
    return sum_points_in_lanes<W, V>(
        n, [=]<class X>(Index j, const X&) __attribute__((always_inline)) {
          const X x = load<X>(u + j);
          store<X>(slope + j, w.slope(x));
          return w.value(x);
        });
  });
}

template <class W>
SEICHE_MULTIVERSION void slopes(const W& w, const double* u, double* slope, std::size_t n) {
  const W local = w;
  if constexpr (TakesBlocks<W>) {
    sum_values_and_slopes(w, u, slope, n);
    return;
  }
  for (std::size_t j = 0; j < n; ++j) slope[j] = local.slope(u[j]);
}

// With u = in · values: values ← out · W'(u).
template <class W>
double slopes_in_place(const W& w, double in, double out, double* values, std::size_t n) {
  return with_lanes([=]<class V>() __attribute__((always_inline)) {
    if constexpr (TakesBlocks<W>) {
      BlockOfPoints u;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before it is read
      return sum_blocks(
          n, [&](std::size_t begin, std::size_t count, double* at) __attribute__((always_inline)) {
            double* const here = values + begin;
            for (std::size_t j = 0; j < count; ++j) u[j] = in * here[j];
            w.values_and_slopes(u.data(), at, here, count);
            for (std::size_t j = 0; j < count; ++j) here[j] *= out;
          });
    }
    return sum_points_in_lanes<W, V>(
        n, [=]<class X>(Index j, const X&) __attribute__((always_inline)) {
          const X x = in * load<X>(values + j);
          store<X>(values + j, out * w.slope(x));
          return w.value(x);
        });
  });
}

template <class W>
void mean_slopes(const W& w, const double* a, const double* b, double* mean, std::size_t n) {
  with_lanes([=]<class V>() __attribute__((always_inline)) {
    if constexpr (TakesBlocks<W>) {
      std::array<double, 2 * LongSum::block> scratch;  // NOLINT(cppcoreguidelines-pro-type-member-init): as above
      for_blocks(
          n, [&](std::size_t begin, std::size_t end) __attribute__((always_inline)) {
            w.mean_slopes(a + begin, b + begin, mean + begin, scratch.data(), end - begin);
          });
    } else if constexpr (HasMeansOfLanes<W>) {
      for_lanes<V>(
          0, static_cast<Index>(n), [=]<class X>(Index j, const X&) __attribute__((always_inline)) {
            store<X>(mean + j, w.mean_slope(load<X>(a + j), load<X>(b + j)));
          });
    } else {
      for (std::size_t j = 0; j < n; ++j) mean[j] = w.mean_slope(a[j], b[j]);
    }
  });
}

}  // namespace seiche
