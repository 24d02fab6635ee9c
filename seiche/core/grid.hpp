// A uniform grid in one dimension.
#pragma once

#include <seiche/core/vector.hpp>

#include <cmath>

namespace seiche {

enum class Boundary { periodic, dirichlet };

// `intervals` cells of width Δx = length / intervals. Unknowns sit at x_j = jΔx: j = 1 … N when periodic
// (x_N ≡ x_0), j = 1 … N−1 where the field vanishes at both ends.
struct Grid {
  Index intervals = 1;
  double length = 1.0;
  Boundary boundary = Boundary::periodic;

  double dx() const { return length / static_cast<double>(intervals); }
  Index unknowns() const { return boundary == Boundary::periodic ? intervals : intervals - 1; }
  double x(Index i) const { return static_cast<double>(i + 1) * dx(); }  // of unknown i = 0, 1, …
};

}  // namespace seiche
