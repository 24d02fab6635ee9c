// A small full matrix times a vector with the sums in registers: for systems of up to some hundred unknowns.
#pragma once

#include <seiche/core/base/vector.hpp>
#include <seiche/core/simd/lanes.hpp>

#include <Eigen/Dense>

namespace seiche {

class LaneMatrix {
 public:
  LaneMatrix() = default;
  explicit LaneMatrix(const Eigen::MatrixXd& a);

  Index columns() const { return columns_; }
  Index padded_rows() const { return padded_rows_; }
  void apply(const double* x, double* y) const;  // y, of padded_rows() numbers, ← A x

 private:
  Index columns_ = 0, padded_rows_ = 0;
  Vector entries_;  // column after column, each filled up with zeros to a multiple of the lanes
};

}  // namespace seiche
