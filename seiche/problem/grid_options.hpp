// The grid of a problem as a user states it: one value for every axis, or one for each.
#pragma once

#include <seiche/core/grid.hpp>
#include <seiche/core/parameter.hpp>
#include <seiche/core/stencil.hpp>

#include <string>
#include <vector>

namespace seiche {

struct GridOptions {
  std::vector<Index> points = {20};  // its longest list, and those below, give the number of axes
  std::vector<double> length = {1.0};
  std::vector<Boundary> boundary = {Boundary::periodic};
  Discretisation discretisation = Discretisation::fd2;
};

// Throws Error where the lists have different lengths (other than one), an axis has no unknown, or the grid would not fit
// into the memory of this machine.
Grid make_grid(const GridOptions& options);

// points, length, boundary and discretisation as parameters of a case file, and back.
std::vector<Parameter> grid_parameters(const std::string& default_points, const std::string& default_length);
GridOptions grid_options(const ParameterValues& values);

// The discretisation alone, for problems in one dimension.
Parameter discretisation_parameter();
Discretisation discretisation_of(const ParameterValues& values);

}  // namespace seiche
