// BᴴPB.
#pragma once

#include <Eigen/Core>

namespace seiche {

// P n × n, B n × m. Of real and complex matrices it is compiled once, in congruence.cpp: every kind of operand of a
// product is compiled anew wherever it stands.
template <class Matrix>
Matrix congruence(const Matrix& P, const Matrix& B) {
  const Matrix PB = P * B;
  return B.adjoint() * PB;
}

extern template Eigen::MatrixXd congruence(const Eigen::MatrixXd& P, const Eigen::MatrixXd& B);
extern template Eigen::MatrixXcd congruence(const Eigen::MatrixXcd& P, const Eigen::MatrixXcd& B);

}  // namespace seiche
