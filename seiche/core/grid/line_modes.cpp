#include <seiche/core/grid/line_modes.hpp>

#include <cmath>
#include <numbers>

namespace seiche {

double sin_pi(Index p, Index q) {
  p %= 2 * q;
  if (p < 0) p += 2 * q;
  const double sign = p < q ? 1.0 : -1.0;
  if (p >= q) p -= q;
  if (2 * p > q) p = q - p;
  if (2 * p == q) return sign;
  return sign * std::sin(std::numbers::pi * static_cast<double>(p) / static_cast<double>(q));
}

Eigen::MatrixXd line_modes(const GridAxis& axis) {
  const Index n = axis.unknowns();
  const Index N = axis.intervals;
  Eigen::MatrixXd modes(n, n);
  for (Index k = 0; k < n; ++k)
    for (Index j = 0; j < n; ++j)
      modes(j, k) =
          axis.boundary == Boundary::dirichlet ? sin_pi((j + 1) * (k + 1), N) : sin_pi((2 * j + 1) * k + N, 2 * N);
  modes.colwise().normalize();
  return modes;
}

}  // namespace seiche
