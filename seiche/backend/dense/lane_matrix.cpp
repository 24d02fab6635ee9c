#include <seiche/backend/dense/lane_matrix.hpp>
#include <seiche/core/simd/with_lanes.hpp>

#include <algorithm>
#include <array>

namespace seiche {
namespace {

// 8 · count rows from `a` on; columns lie `stride` apart. Few rows have two sums each, so that additions need not wait
// for one another.
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

template <class V>
[[gnu::always_inline]] inline void apply_all(const double* a, Index rows, Index columns, const double* x, double* y) {
  constexpr Index most = 5 * lane_count;  // of the rows whose sums the registers hold
  if (columns == 0) {
    std::fill_n(y, rows, 0.0);
    return;
  }
  for (Index row = 0; row < rows; row += most) {
    switch (std::min(most, rows - row) / lane_count) {
      case 5: apply_rows<V, 5>(a + row, rows, columns, x, y + row); break;
      case 4: apply_rows<V, 4>(a + row, rows, columns, x, y + row); break;
      case 3: apply_rows<V, 3>(a + row, rows, columns, x, y + row); break;
      case 2: apply_rows<V, 2>(a + row, rows, columns, x, y + row); break;
      default: apply_rows<V, 1>(a + row, rows, columns, x, y + row); break;
    }
  }
}

}  // namespace

LaneMatrix::LaneMatrix(const Eigen::MatrixXd& a)
    : columns_(a.cols()), padded_rows_((a.rows() + lane_count - 1) / lane_count * lane_count) {
  entries_.setZero(padded_rows_ * columns_);
  for (Index j = 0; j < columns_; ++j) entries_.segment(j * padded_rows_, a.rows()) = a.col(j);
}

void LaneMatrix::apply(const double* x, double* y) const {
  const double* const a = entries_.data();
  with_lanes([ =, rows = padded_rows_, columns = columns_ ]<class V>()
                 __attribute__((always_inline)) { apply_all<V>(a, rows, columns, x, y); });
}

}  // namespace seiche
