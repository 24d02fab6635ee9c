#include <seiche/problem/gradient_flow/initial_fields.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace seiche {
namespace {

// A low mode of an axis; around a ring each begins elsewhere.
double wave(const GridAxis& axis, double x, int k) {
  const double turns = k * x / axis.length;
  switch (axis.boundary) {
    case Boundary::periodic: return std::cos(2 * std::numbers::pi * turns + k * k);
    case Boundary::neumann: return std::cos(std::numbers::pi * turns);
    case Boundary::dirichlet: break;
  }
  return std::sin(std::numbers::pi * turns);
}

}  // namespace

Vector low_waves(const Grid& grid, double mean, double amplitude) {
  constexpr std::array<std::array<int, 3>, 4> modes = {{{1, 2, 1}, {2, 1, 3}, {3, 4, 2}, {5, 3, 1}}};
  Vector u(grid.unknowns());
  for (Index i = 0; i < u.size(); ++i) {
    double sum = 0;
    for (const auto& k : modes) {
      double product = 1;
      for (Index a = 0; a < grid.dimension(); ++a)
        product *= wave(grid.axis(a), grid.coordinate(i, a), k[static_cast<std::size_t>(a)]);
      sum += product;
    }
    u[i] = mean + amplitude * sum / static_cast<double>(modes.size());
  }
  return u;
}

double distance_from_centre(const Grid& grid, Index point) {
  double squared = 0;
  for (Index a = 0; a < grid.dimension(); ++a) squared += square(grid.coordinate(point, a) - grid.axis(a).length / 2);
  return std::sqrt(squared);
}

}  // namespace seiche
