// What gradient flows of one field share: S, no damping, and initial data for them to take apart.
#pragma once

#include <seiche/core/problem.hpp>
#include <seiche/problem/common/grid_options.hpp>

#include <functional>
#include <string>

namespace seiche {

// u_t = −m δH/δu, or mΔ δH/δu where the mean of u is conserved; without M, V and z₀. Throws Error where m is not > 0.
struct Mobility {
  double m = 1.0;
  bool conserves_mean = false;
};
Problem flow_of_one_field(std::string name, const GridOptions& grid, const Mobility& mobility);

// mean + A times the mean of four products of low modes of the axes: it has no symmetry of the grid, and is the same
// function whatever the number of points. Where a field is held at zero it jumps to the mean beside the end.
Vector low_waves(const Grid& grid, double mean, double amplitude);

// f(|x − L/2|), of the distance from the centre.
Vector around_centre(const Grid& grid, const std::function<double(double distance)>& f);

}  // namespace seiche
