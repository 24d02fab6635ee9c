#include <seiche/backend/dense/lane_matrix.hpp>
#include <seiche/core/simd/with_lanes.hpp>

#include <algorithm>

namespace seiche {

LaneMatrix::LaneMatrix(const Eigen::MatrixXd& a) : columns_(a.cols()), padded_rows_(whole_lanes(a.rows())) {
  entries_ = CacheLines(static_cast<std::size_t>(padded_rows_ * columns_));
  double* block = entries_.data();
  for (Index row = 0; row < a.rows(); row += block_rows) {
    const Index rows = std::min(block_rows, a.rows() - row), stride = std::min(block_rows, padded_rows_ - row);
    for (Index j = 0; j < columns_; ++j, block += stride) Eigen::Map<Vector>(block, rows) = a.col(j).segment(row, rows);
  }
}

void LaneMatrix::apply(const double* x, double* y) const {
  with_lanes([ a = view(), x, y ]<class V>() __attribute__((always_inline)) { a.template apply<V>(x, y); });
}

}  // namespace seiche
