// The grid of a problem as a user states it: one value for every axis, or one for each.
#pragma once

#include <seiche/core/grid/grid.hpp>
#include <seiche/core/grid/stencil.hpp>
#include <seiche/core/parameter.hpp>
#include <seiche/core/potential.hpp>

#include <memory>
#include <string>
#include <vector>

namespace seiche {

// Along one axis of a case file. Lengths in FFTW and indices in sparse matrices are ints, which must count the entries
// of several fields. Whether the memory suffices is asked by make_grid.
inline constexpr Index most_intervals = Index{1} << 26;

struct GridOptions {
  std::vector<Index> points = {20};  // the longer of this list and the next gives the number of axes
  std::vector<double> length = {1.0};
  std::vector<Boundary> boundary = {Boundary::periodic};
  Discretisation discretisation = Discretisation::fd2;
  bool two_thirds = false;  // V sees the modes with |k| < N/3 only; needs periodic axes and spectral derivatives
  Rank here = {};           // whose part of it is made
};

// Throws Error where the lists have different lengths (other than one), a length is not a finite number > 0, an axis
// has no unknown, or the grid would not fit into the memory of this machine.
Grid make_grid(const GridOptions& options);

// V as the options ask for it: V(u), or V(Pu) by the two-thirds rule. Throws Error where that rule has no meaning.
std::shared_ptr<const PointwisePotential> on_grid(std::shared_ptr<const PointwisePotential> potential, const Grid& grid,
                                                  const GridOptions& options);

// points, length, boundary, discretisation and dealias as parameters of a case file, and back.
std::vector<Parameter> grid_parameters(const std::string& default_points, const std::string& default_length);
GridOptions grid_options(const ParameterValues& values);

// points, length and boundary alone.
std::vector<Parameter> axes_parameters(const std::string& default_points, const std::string& default_length);
std::vector<Parameter> axes_parameters(const GridOptions& defaults);
GridOptions axes_options(const ParameterValues& values);
Boundary boundary_named(const std::string& name);

// Each of the others.
Parameter discretisation_parameter();
Discretisation discretisation_of(const ParameterValues& values);
Parameter dealias_parameter();
bool two_thirds_of(const ParameterValues& values);

}  // namespace seiche
