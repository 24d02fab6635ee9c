#include <seiche/core/text/axis_names.hpp>
#include <seiche/output/solution_layout.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>

namespace seiche {
namespace {

constexpr std::uint64_t chunk_values = 1U << 16U;  // of a row that is cut
constexpr std::uint64_t rows_values = 1U << 14U;   // of several rows: 128 kB, which fits on a disk that is nearly full
constexpr std::uint64_t most_rows = 1024;

SolutionAxis grid_axis(const GridAxis& axis, const char* name) {
  SolutionAxis result{.name = name, .meaning = fmt::format("{} coordinate of the grid", name), .values = {}};
  for (Index i = 0; i < axis.unknowns(); ++i) result.values.push_back(axis.x(i));
  result.spacing = axis.dx();
  return result;
}

SolutionAxis numbers(Index count) {
  SolutionAxis result{.name = "point", .meaning = "number of the point", .values = {}};
  for (Index i = 1; i <= count; ++i) result.values.push_back(static_cast<double>(i));
  return result;
}

}  // namespace

Hdf5Shape SolutionLayout::shape() const {
  Hdf5Shape sizes;
  for (const SolutionAxis& axis : axes) sizes.push_back(axis.values.size());
  return sizes;
}

std::uint64_t SolutionLayout::points() const {
  const Hdf5Shape sizes = shape();
  return std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{1}, std::multiplies<>());
}

std::string SolutionLayout::mesh() const {
  if (axes.empty() || (on_grid() && axes.size() == 1)) return "";
  return on_grid() || !nodes.empty() ? "mesh/points" : "mesh/numbers";
}

Hdf5Shape SolutionLayout::chunk() const {
  Hdf5Shape sizes = shape();
  std::uint64_t row = points();
  for (std::uint64_t& size : sizes) {
    if (row <= chunk_values) break;
    row /= size;
    size = std::clamp<std::uint64_t>(chunk_values / row, 1, size);
    row *= size;
  }
  sizes.insert(sizes.begin(), std::clamp<std::uint64_t>(rows_values / row, 1, most_rows));
  return sizes;
}

SolutionLayout solution_layout(const Problem& problem) {
  SolutionLayout layout;
  const Grid grid = problem.grid.whole();
  if (grid.unknowns() > 1 && grid.only_numbers) {
    layout.axes.push_back(numbers(grid.unknowns()));
    layout.nodes = grid.nodes;
    layout.supports = grid.supports;
    layout.bars = grid.bars;
  } else if (grid.unknowns() > 1) {
    for (Index a = 0; a < grid.dimension(); ++a)
      layout.axes.push_back(grid_axis(grid.axis(a), axis_names[static_cast<std::size_t>(a)]));
  }
  std::vector<std::string> taken = {"t", "H", "H_modified", "mesh", "point"};
  for (const SolutionAxis& axis : layout.axes) taken.push_back(axis.name);
  for (std::string name : problem.fields) {
    while (std::find(taken.begin(), taken.end(), name) != taken.end()) name += "_field";
    taken.push_back(name);
    layout.fields.push_back(name);
  }
  return layout;
}

}  // namespace seiche
