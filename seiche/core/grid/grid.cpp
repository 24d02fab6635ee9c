#include <seiche/core/grid/grid.hpp>

#include <algorithm>

namespace seiche {

Slab Grid::slab() const {
  const Index planes = axis(0).unknowns();
  return dimension() > 1 ? slab_of({planes}, here) : Slab{0, planes};
}

FieldPart Grid::field() const {
  const Units planes = dimension() > 1 ? Units{.planes = slab().planes, .of = axis(0).unknowns()} : Units{};
  return {unknowns(), planes, first_unknown(), whole().unknowns()};
}

Grid Grid::whole() const {
  Grid grid = *this;
  grid.here = {};
  return grid;
}

Index Grid::unknowns() const {
  Index n = slab().planes;
  for (Index a = 1; a < dimension(); ++a) n *= axis(a).unknowns();
  return n;
}

Index Grid::first_unknown() const {
  Index n = slab().first;
  for (Index a = 1; a < dimension(); ++a) n *= axis(a).unknowns();
  return n;
}

double Grid::coordinate(Index point, Index a) const {
  for (Index b = dimension() - 1; b > a; --b) point /= axis(b).unknowns();
  return axis(a).x(a == 0 ? slab().first + point : point % axis(a).unknowns());
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
