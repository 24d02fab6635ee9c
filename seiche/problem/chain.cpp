#include <seiche/potential/polynomials.hpp>
#include <seiche/potential/sum.hpp>
#include <seiche/problem/chain.hpp>
#include <seiche/problem/common/grid_options.hpp>
#include <seiche/problem/common/problem_rows.hpp>
#include <seiche/problem/common/wave.hpp>

#include <cmath>
#include <numbers>

namespace seiche {
namespace {

Vector first_mode(const Grid& grid, double amplitude) {
  const GridAxis& axis = grid.axis(0);
  const double wave_number = (axis.boundary == Boundary::periodic ? 2 : 1) * std::numbers::pi / axis.length;
  return sample(grid, [&](double x) {
    const double phase = wave_number * x;
    return amplitude * (axis.boundary == Boundary::neumann ? std::cos(phase) : std::sin(phase));
  });
}

}  // namespace

Problem chain(const Chain& options) {
  const Grid grid = make_grid({.points = {options.points},
                               .length = {static_cast<double>(options.points)},  // Δx = 1
                               .boundary = {options.boundary}});
  const Stencil R = Stencil::laplacian(grid);
  Problem p = wave_problem("chain", grid, Stencil::identity(options.ground_spring) + -options.neighbour_spring * R,
                           options.gamma);
  p.fields = {"u", "p"};
  p.M(1, 1) = Stencil::identity(1 / options.mass);
  p.damping.constant(1, 1) = -options.neighbour_damping * R;
  const auto bonds = bond_polynomial({0, 0, 0, 0, options.neighbour_cubic / 4}, options.boundary);
  const auto ground = nodal_polynomial({0, 0, 0, 0, options.ground_cubic / 4});
  p.potential = options.ground_cubic == 0 ? bonds : sum_of({{bonds, 0}, {ground, 0}}, 1);

  const Index n = grid.unknowns();
  if (options.initial == Chain::Initial::first_mode) {
    p.initial.head(n) = first_mode(grid, options.amplitude);
  } else {
    p.initial[n + n / 2] = options.mass * options.amplitude;
  }
  return p;
}

Parameter chain_boundary_parameter(const std::string& default_value) {
  return {.name = "boundary",
          .kind = ParameterKind::choice,
          .default_value = default_value,
          .meaning = "fixed ends, a ring, or free ends",
          .choices = {"dirichlet", "periodic", "neumann"}};
}

Boundary chain_boundary(const ParameterValues& values) { return boundary_named(values.choice("boundary")); }

ProblemEntry chain_entry() {
  using P = Chain;
  return ProblemRows<P>(
             {.name = "chain",
              .title = "Chain of masses",
              .equation = "mü_j = k(d_j − d_{j−1}) + k₃(d_j³ − d_{j−1}³) − gu_j − g₃u_j³ − mγu̇_j + mν(ḋ_j − ḋ_{j−1}), "
                          "d_j = u_{j+1} − u_j",
              .reference = "Li, Li, Shang, Xu, section 1; Born, von Kármán (1912)",
              .fields = {"u", "p"},
              .meanings = {"displacement", "momentum"},
              .default_h = "1/64",
              .default_end = 50.0},
             chain)
      .row(&P::points, {.name = "points",
                        .meaning = "N, masses on a ring or with free ends; N − 1 between fixed ends",
                        .minimum = 2,
                        .maximum = most_intervals})
      .row(chain_boundary_parameter("dirichlet"),
           [](P& p, const ParameterValues& v) { p.boundary = chain_boundary(v); })
      .row(&P::mass, {.name = "mass", .meaning = "m", .minimum = 0, .minimum_excluded = true})
      .row(&P::neighbour_spring,
           {.name = "neighbour_spring", .meaning = "k, stiffness of the springs between neighbours", .minimum = 0})
      .row(&P::neighbour_cubic,
           {.name = "neighbour_cubic", .default_value = "0.5", .meaning = "k₃, their cubic stiffness"})
      .row(&P::ground_spring, {.name = "ground_spring",
                               .default_value = "0.1",
                               .meaning = "g, stiffness of the springs to the ground",
                               .minimum = 0})
      .row(&P::ground_cubic, {.name = "ground_cubic", .default_value = "0.1", .meaning = "g₃, their cubic stiffness"})
      .row(&P::neighbour_damping, {.name = "neighbour_damping",
                                   .default_value = "0.05",
                                   .meaning = "ν, dashpots between neighbours over m, 1/time",
                                   .minimum = 0})
      .row(&P::gamma, {.name = "gamma", .default_value = "0.01", .meaning = "γ, dashpots to the ground over m, 1/time"})
      .row(&P::amplitude, {.name = "amplitude", .meaning = "of the initial data"})
      .presets(&P::initial, {"kick", "first_mode"});
}

}  // namespace seiche
