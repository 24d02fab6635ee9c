// The worst of many numbers.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace seiche::test {

// std::max(x, NaN) is x, and so may be Eigen's largest entry: a test of either passes on results that are NaN.
// Here NaN is the worst there is.
inline double worse(double a, double b) { return std::isnan(a) || a > b ? a : b; }

// The largest |a_ij|.
template <class Derived>
double largest(const Eigen::MatrixBase<Derived>& a) {
  return a.size() == 0 ? 0.0 : a.cwiseAbs().template maxCoeff<Eigen::PropagateNaN>();
}

}  // namespace seiche::test
