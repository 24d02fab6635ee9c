// A small full matrix times a vector with the sums in registers: for systems of up to some hundred unknowns.
#pragma once

#include <seiche/core/base/vector.hpp>
#include <seiche/core/simd/cache_lines.hpp>
#include <seiche/core/simd/lanes.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <array>

namespace seiche {

class LaneMatrix {
 public:
  LaneMatrix() = default;
  explicit LaneMatrix(const Eigen::MatrixXd& a);

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
  CacheLines entries_;  // column after column, each filled up with zeros to a multiple of the lanes
};

namespace lane_matrix {

// 8 · count rows from `a` on; columns lie `stride` apart. Few rows have several sums each, so that additions need not
// wait for one another.
template <class V, int count>
[[gnu::always_inline]] inline void apply_rows(const double* a, Index stride, Index columns, const double* x,
                                              double* y) {
  constexpr int parts = count <= 2 ? 4 : count == 3 ? 2 : 1;
  std::array<std::array<V, count>, parts> sums{};
  Index j = 0;
  for (; j + parts <= columns; j += parts)
    for (int part = 0; part < parts; ++part)
      for (int i = 0; i < count; ++i) sums[part][i] += x[j + part] * load<V>(a + (j + part) * stride + lane_count * i);
  for (; j < columns; ++j)
    for (int i = 0; i < count; ++i) sums[0][i] += x[j] * load<V>(a + j * stride + lane_count * i);
  for (int i = 0; i < count; ++i) {
    for (int part = 1; part < parts; ++part) sums[0][i] += sums[part][i];
    store<V>(y + lane_count * i, sums[0][i]);
  }
}

}  // namespace lane_matrix

template <class V>
[[gnu::always_inline]] inline void LaneMatrix::View::apply(const double* x, double* y) const {
  constexpr Index most = 5 * lane_count;  // of the rows whose sums the registers hold
  if (columns == 0) {
    std::fill_n(y, rows, 0.0);
    return;
  }
  for (Index row = 0; row < rows; row += most) {
    const double* const a = entries + row;
    switch (std::min(most, rows - row) / lane_count) {
      case 5: lane_matrix::apply_rows<V, 5>(a, rows, columns, x, y + row); break;
      case 4: lane_matrix::apply_rows<V, 4>(a, rows, columns, x, y + row); break;
      case 3: lane_matrix::apply_rows<V, 3>(a, rows, columns, x, y + row); break;
      case 2: lane_matrix::apply_rows<V, 2>(a, rows, columns, x, y + row); break;
      default: lane_matrix::apply_rows<V, 1>(a, rows, columns, x, y + row); break;
    }
  }
}

}  // namespace seiche
