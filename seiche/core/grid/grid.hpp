// A uniform grid in one, two or three dimensions.
#pragma once

#include <seiche/core/base/vector.hpp>
#include <seiche/core/grid/units.hpp>

#include <array>
#include <vector>

namespace seiche {

using Place = std::array<double, 3>;  // x, y, z; zero along axes that are not there

enum class Boundary { periodic, dirichlet, neumann };

// What j of x = jΔx is at x = 0, in the numbering of the next declaration.
inline double index_at_origin(Boundary boundary) { return boundary == Boundary::neumann ? 0.5 : 0.0; }

// `intervals` cells of width Δx = length / intervals. Unknowns sit at x = jΔx: j = 1 … N when periodic (x_N ≡ x_0),
// j = 1 … N−1 where the field vanishes at both ends, and at the middles x = (j − ½)Δx, j = 1 … N, where its derivative
// does: then the mirror lies half a cell outside, and differences stay symmetric.
struct GridAxis {
  Index intervals = 1;
  double length = 1.0;
  Boundary boundary = Boundary::periodic;

  double dx() const { return length / static_cast<double>(intervals); }
  Index unknowns() const { return boundary == Boundary::dirichlet ? intervals - 1 : intervals; }
  double x(Index i) const {  // of unknown i = 0, 1, …
    return (static_cast<double>(i) + 1 - index_at_origin(boundary)) * dx();
  }
};

// Points are numbered with the last axis running fastest.
struct Grid {
  std::vector<GridAxis> axes = {GridAxis{}};
  // Points that lie on no grid: the one axis only numbers them. They are at `nodes`, or nowhere if that is empty.
  bool only_numbers = false;
  std::vector<Place> nodes = {};
  // What stands between nodes, for pictures: both ends of every bar, as numbers of `nodes` and behind them of
  // `supports`, which do not move.
  std::vector<Place> supports = {};
  std::vector<std::array<Index, 2>> bars = {};
  // Of several processes each holds a slab of planes along axis 0, whose points alone are counted and placed. One axis
  // is not cut.
  Rank here = {};

  Slab slab() const;            // of axis 0
  Index first_unknown() const;  // the number in the whole grid of the first one here
  Grid whole() const;
  FieldPart field() const;  // the values of a field: planes along axis 0

  Index dimension() const { return static_cast<Index>(axes.size()); }
  const GridAxis& axis(Index a) const { return axes[static_cast<std::size_t>(a)]; }
  Index unknowns() const;                         // here
  double coordinate(Index point, Index a) const;  // of unknown `point` along axis a
  Place place(Index point) const;
  bool is_periodic() const;  // along every axis
};

}  // namespace seiche
