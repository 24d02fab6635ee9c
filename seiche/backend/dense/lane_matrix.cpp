#include <seiche/backend/dense/lane_matrix.hpp>
#include <seiche/core/simd/with_lanes.hpp>

namespace seiche {

LaneMatrix::LaneMatrix(const Eigen::MatrixXd& a) : columns_(a.cols()), padded_rows_(whole_lanes(a.rows())) {
  entries_ = CacheLines(static_cast<std::size_t>(padded_rows_ * columns_));
  for (Index j = 0; j < columns_; ++j)
    for (Index i = 0; i < a.rows(); ++i) entries_.data()[j * padded_rows_ + i] = a(i, j);
}

void LaneMatrix::apply(const double* x, double* y) const {
  with_lanes([ a = view(), x, y ]<class V>() __attribute__((always_inline)) { a.template apply<V>(x, y); });
}

}  // namespace seiche
