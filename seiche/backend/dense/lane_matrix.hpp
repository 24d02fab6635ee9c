// A small full matrix times a vector with the sums in registers: for systems of up to some hundred unknowns.
#pragma once

#include <seiche/core/base/vector.hpp>
#include <seiche/core/simd/cache_lines.hpp>
#include <seiche/core/simd/lanes.hpp>

#include <Eigen/Dense>

#include <array>

namespace seiche {

class LaneMatrix {
 public:
  LaneMatrix() = default;
  explicit LaneMatrix(const Eigen::MatrixXd& a);

  static constexpr Index block_rows = 5 * lane_count;  // whose sums any processor has registers for

  Index columns() const { return columns_; }
  Index padded_rows() const { return padded_rows_; }
  void apply(const double* x, double* y) const;  // y, of padded_rows() numbers, ← A x

  // The same inside a body of with_lanes, which takes a view by value.
  struct View {
    const double* entries;
    Index rows, columns;

    template <class V>
    [[gnu::always_inline]] inline void apply(const double* x, double* y) const;
  };
  View view() const { return {entries_.data(), padded_rows_, columns_}; }

 private:
  Index columns_ = 0, padded_rows_ = 0;
  CacheLines entries_;  // block after block, each column after column, filled up with zeros to a multiple of the lanes
};

namespace lane_matrix {

// A block of 8 · count rows. Few rows have several sums each, so that additions need not wait for one another; how
// many does not depend on the registers, and so neither does the order of additions. Loops over sums are unrolled by
// order: the compiler does so too late to keep them all in registers.
template <class V, int count>
[[gnu::always_inline]] inline void apply_block(const double* a, Index columns, const double* x, double* y) {
  constexpr int parts = count == 1 ? 4 : count <= 3 ? 2 : 1;
  constexpr int stride = lane_count * count;
  std::array<std::array<V, count>, parts> sums{};
  const double* const end = x + columns;
  for (; end - x >= parts; x += parts, a += parts * stride) {
#pragma GCC unroll 4
    for (int part = 0; part < parts; ++part)
#pragma GCC unroll 5
      for (int i = 0; i < count; ++i) sums[part][i] += x[part] * load<V>(a + part * stride + lane_count * i);
  }
  if constexpr (parts > 1) {
    for (; x < end; ++x, a += stride)
#pragma GCC unroll 5
      for (int i = 0; i < count; ++i) sums[0][i] += *x * load<V>(a + lane_count * i);
  }
#pragma GCC unroll 5
  for (int i = 0; i < count; ++i) {
#pragma GCC unroll 4
    for (int part = 1; part < parts; ++part) sums[0][i] += sums[part][i];
    store<V>(y + lane_count * i, sums[0][i]);
  }
}

}  // namespace lane_matrix

template <class V>
[[gnu::always_inline]] inline void LaneMatrix::View::apply(const double* x, double* y) const {
  const double* a = entries;
  Index left = rows;
  for (; left >= block_rows; left -= block_rows, a += block_rows * columns, y += block_rows)
    lane_matrix::apply_block<V, 5>(a, columns, x, y);
  switch (left) {
    case 4 * lane_count: lane_matrix::apply_block<V, 4>(a, columns, x, y); break;
    case 3 * lane_count: lane_matrix::apply_block<V, 3>(a, columns, x, y); break;
    case 2 * lane_count: lane_matrix::apply_block<V, 2>(a, columns, x, y); break;
    case lane_count: lane_matrix::apply_block<V, 1>(a, columns, x, y); break;
    default: break;
  }
}

}  // namespace seiche
