// The modes of one axis of a grid, point by point.
#pragma once

#include <seiche/core/grid/grid.hpp>

#include <Eigen/Dense>

namespace seiche {

// sin(πp/q), exact where it is 0 or ±1.
double sin_pi(Index p, Index q);

// Of an axis that is not periodic: orthonormal sines or cosines as columns, in the order of Modes.
Eigen::MatrixXd line_modes(const GridAxis& axis);

}  // namespace seiche
