// How long a matrix may make vectors.
#pragma once

#include <Eigen/Dense>

namespace seiche {

// At least |Ax|²/|x|² for every x: the largest sum of sizes in a row, times that in a column.
inline double squared_norm_bound(const Eigen::MatrixXd& A) {
  if (A.size() == 0) return 0;
  return A.cwiseAbs().rowwise().sum().maxCoeff() * A.cwiseAbs().colwise().sum().maxCoeff();
}

}  // namespace seiche
