#include <seiche/core/grid/grid.hpp>

#include <algorithm>

namespace seiche {

Index Grid::unknowns() const {
  Index n = 1;
  for (const GridAxis& a : axes) n *= a.unknowns();
  return n;
}

double Grid::coordinate(Index point, Index a) const {
  for (Index b = dimension() - 1; b > a; --b) point /= axis(b).unknowns();
  return axis(a).x(point % axis(a).unknowns());
}

Place Grid::place(Index point) const {
  Place x{};
  for (Index a = 0; a < dimension(); ++a) x[static_cast<std::size_t>(a)] = coordinate(point, a);
  return x;
}

bool Grid::is_periodic() const {
  return std::all_of(axes.begin(), axes.end(), [](const GridAxis& a) { return a.boundary == Boundary::periodic; });
}

}  // namespace seiche
