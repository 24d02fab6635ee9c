// Vectors of the state space, and what an index into them is.
#pragma once

#include <Eigen/Core>
#include <limits>

namespace seiche {

using Vector = Eigen::VectorXd;
using Index = Eigen::Index;

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();

inline double square(double x) { return x * x; }

}  // namespace seiche
