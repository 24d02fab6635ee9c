#include <seiche/core/base/error.hpp>
#include <seiche/core/base/memory_limit.hpp>
#include <seiche/core/text/number_text.hpp>
#include <seiche/core/truncated_potential.hpp>
#include <seiche/problem/common/grid_options.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

template <class T>
T of_axis(const std::vector<T>& list, std::size_t axis) {
  return list.size() == 1 ? list.front() : list[axis];
}

// Before anything is allocated: less than the leanest method takes for one field (docs/performance.md). Simulation asks
// again for the method at hand.
void require_memory(const Grid& grid) {
  constexpr double bytes_per_point = 200;
  double points = static_cast<double>(grid.slab().planes);
  for (Index a = 1; a < grid.dimension(); ++a) points *= static_cast<double>(grid.axis(a).unknowns());
  const double needed = bytes_per_point * points;
  if (needed > memory_limit())
    throw Error(
        "a grid of {:.0f} points needs at least {:.3g} bytes, but only {:.3g} are available; choose fewer points",
        points, needed, memory_limit());
}

}  // namespace

Grid make_grid(const GridOptions& options) {
  constexpr std::size_t most_axes = 3;
  const std::size_t axes = std::max(options.points.size(), options.length.size());
  const auto fits = [axes](std::size_t size) { return size == 1 || size == axes; };
  if (axes > most_axes || !fits(options.points.size()) || !fits(options.length.size()) ||
      !fits(options.boundary.size())) {
    throw Error(
        "points has {} entries, length {} and boundary {}: points and length say how many axes there are, at most {}, and each "
        "list needs one entry, or one for each axis",
        options.points.size(), options.length.size(), options.boundary.size(), most_axes);
  }
  Grid grid;
  grid.axes.clear();
  for (std::size_t a = 0; a < axes; ++a) {
    const GridAxis axis{of_axis(options.points, a), of_axis(options.length, a), of_axis(options.boundary, a)};
    if (!(axis.length > 0) || !std::isfinite(axis.length))
      throw Error("length = {} along axis {} must be a finite number > 0", axis.length, a + 1);
    if (axis.unknowns() < 1) throw Error("points = {} leaves no unknown along axis {}", axis.intervals, a + 1);
    grid.axes.push_back(axis);
  }
  grid.here = options.here;
  require_memory(grid);
  return grid;
}

std::shared_ptr<const PointwisePotential> on_grid(std::shared_ptr<const PointwisePotential> potential, const Grid& grid,
                                                  const GridOptions& options) {
  if (!options.two_thirds) return potential;
  if (!grid.is_periodic() || options.discretisation != Discretisation::spectral)
    throw Error(
        "dealias = \"two_thirds\" needs a spectral discretisation on a grid that is periodic along every axis: "
        "differences and ends have no modes to leave out");
  return std::make_shared<TruncatedPotential>(std::move(potential), grid);
}

std::vector<Parameter> axes_parameters(const std::string& default_points, const std::string& default_length) {
  return {
      {.name = "length",
       .default_value = default_length,
       .meaning = "L, size of the domain",
       .minimum = 0,
       .minimum_excluded = true,
       .per_axis = true},
      {.name = "points",
       .kind = ParameterKind::integer,
       .default_value = default_points,
       .meaning = "N, grid intervals",
       .minimum = 2,
       .maximum = most_intervals,
       .per_axis = true},
      {.name = "boundary",
       .kind = ParameterKind::choice,
       .default_value = "periodic",
       .meaning = "what happens at the ends",
       .choices = {"periodic", "dirichlet", "neumann"},
       .per_axis = true},
  };
}

std::vector<Parameter> axes_parameters(const GridOptions& defaults) {
  std::vector<Parameter> parameters = axes_parameters(std::to_string(defaults.points.front()), "");
  parameters[0].default_value = toml_real(defaults.length.front());
  parameters[2].default_value = parameters[2].choices.at(static_cast<std::size_t>(defaults.boundary.front()));
  return parameters;
}

std::vector<Parameter> grid_parameters(const std::string& default_points, const std::string& default_length) {
  std::vector<Parameter> parameters = axes_parameters(default_points, default_length);
  parameters.push_back(discretisation_parameter());
  parameters.push_back(dealias_parameter());
  return parameters;
}

Boundary boundary_named(const std::string& name) {
  if (name == "dirichlet") return Boundary::dirichlet;
  return name == "neumann" ? Boundary::neumann : Boundary::periodic;
}

GridOptions axes_options(const ParameterValues& values) {
  GridOptions options{.points = values.integers("points"), .length = values.reals("length"), .boundary = {}};
  options.here = values.here;
  for (const std::string& name : values.choices("boundary")) options.boundary.push_back(boundary_named(name));
  return options;
}

GridOptions grid_options(const ParameterValues& values) {
  GridOptions options = axes_options(values);
  options.discretisation = discretisation_of(values);
  options.two_thirds = two_thirds_of(values);
  return options;
}

Parameter discretisation_parameter() {
  return {.name = "discretisation",
          .kind = ParameterKind::choice,
          .default_value = "fd2",
          .meaning = "derivatives: finite differences of order 2 or 4, or spectral",
          .choices = {"fd2", "fd4", "spectral"}};
}

Discretisation discretisation_of(const ParameterValues& values) {
  const std::string& name = values.choice("discretisation");
  if (name == "spectral") return Discretisation::spectral;
  return name == "fd4" ? Discretisation::fd4 : Discretisation::fd2;
}

Parameter dealias_parameter() {
  return {.name = "dealias",
          .kind = ParameterKind::choice,
          .default_value = "none",
          .meaning = "two_thirds: V sees the modes with |k| < N/3 only; needs periodic and spectral",
          .choices = {"none", "two_thirds"}};
}

bool two_thirds_of(const ParameterValues& values) { return values.choice("dealias") == "two_thirds"; }

}  // namespace seiche
