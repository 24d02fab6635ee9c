#include <seiche/core/base/error.hpp>
#include <seiche/problem/common/wave.hpp>
#include <seiche/problem/gradient_flow/one_field.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

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

Problem flow_of_one_field(std::string name, const GridOptions& grid, const Mobility& mobility) {
  if (!(mobility.m > 0)) throw Error("mobility = {} must be > 0", mobility.m);
  Problem p;
  p.name = std::move(name);
  p.grid = make_grid(grid);
  p.fields = {"u"};
  p.S = p.M = BlockStencil(1);
  p.S(0, 0) = mobility.conserves_mean ? mobility.m * Stencil::laplacian(p.grid, grid.discretisation)
                                      : Stencil::identity(-mobility.m);
  p.damping = rate_damping(nullptr, p.grid, {false});
  return p;
}

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

Vector around_centre(const Grid& grid, const std::function<double(double)>& f) {
  Vector u(grid.unknowns());
  for (Index i = 0; i < u.size(); ++i) u[i] = f(std::sqrt(squared_distance_from_centre(grid, i)));
  return u;
}

}  // namespace seiche
