// Initial data of one field that a gradient flow takes apart.
#pragma once

#include <seiche/core/base/vector.hpp>
#include <seiche/core/grid/grid.hpp>

namespace seiche {

// mean + A times the mean of four products of low modes of the axes: it has no symmetry of the grid, and is the same
// function whatever the number of points. Where a field is held at zero it jumps to the mean beside the end.
Vector low_waves(const Grid& grid, double mean, double amplitude);

// |x − L/2|, the distance of a point from the centre.
double distance_from_centre(const Grid& grid, Index point);

}  // namespace seiche
