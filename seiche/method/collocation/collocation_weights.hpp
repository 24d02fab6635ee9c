// A force that is a polynomial in time, as weights of φ-functions.
#pragma once

#include <Eigen/Dense>

#include <vector>

namespace seiche {

// ż = Lz + Σ_k a_k (t/h)ᵏ with a_k = Σ_j C_kj n_j has the solution φ₀(θhL)z + h Σ_k k! θ^{k+1} φ_{k+1}(θhL) a_k at t =
// θh: the weights k! θ^{k+1} C_kj of PhiRow, for C with a row for each power and a column for each force.
inline std::vector<double> collocation_weights(const Eigen::MatrixXd& C, double theta) {
  std::vector<double> weights;
  for (Eigen::Index j = 0; j < C.cols(); ++j) {
    double factor = theta;
    for (Eigen::Index k = 0; k < C.rows(); ++k) {
      weights.push_back(factor * C(k, j));
      factor *= theta * static_cast<double>(k + 1);
    }
  }
  return weights;
}

}  // namespace seiche
