// Initial data of one field that a gradient flow takes apart.
#pragma once

#include <seiche/core/base/vector.hpp>
#include <seiche/core/grid/grid.hpp>

namespace seiche {

// mean + A Σ of four products of low modes of the axes, of norm one in the maximum: it has no symmetry of the grid, is
// smooth up to the ends, and is the same function whatever the number of points.
Vector low_waves(const Grid& grid, double mean, double amplitude);

// |x − L/2|, the distance of a point from the centre.
double distance_from_centre(const Grid& grid, Index point);

}  // namespace seiche
