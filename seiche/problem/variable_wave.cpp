#include <seiche/core/base/error.hpp>
#include <seiche/potential/polynomials.hpp>
#include <seiche/problem/common/problem_rows.hpp>
#include <seiche/problem/common/second_order.hpp>
#include <seiche/problem/common/wave.hpp>
#include <seiche/problem/variable_wave.hpp>

#include <cmath>

namespace seiche {
namespace {

double speed_squared(const VariableWave& options, const Place& x) {
  const double c = options.speed ? options.speed(x) : 1.0;
  if (!(c > 0) || !std::isfinite(c)) throw Error("the wave speed c = {} at x = {:.6g} must be > 0", c, x[0]);
  return square(c);
}

// m²I − ∇·c²∇: what flows through the face between two points is ĉ²(u_right − u_left)/Δx.
SparseMatrix stiffness(const VariableWave& options, const Grid& grid) {
  const Index n = grid.unknowns();
  std::vector<Entry> entries;
  for (Index i = 0; i < n; ++i) entries.push_back({i, i, square(options.mass)});
  Index stride = 1;
  for (Index a = grid.dimension() - 1; a >= 0; stride *= grid.axis(a).unknowns(), --a) {
    const GridAxis& axis = grid.axis(a);
    const double to_axis = 1 / square(axis.dx());
    const auto face = [&](Index i, double offset) {
      Place beside = grid.place(i);
      beside[static_cast<std::size_t>(a)] += offset;
      const double here = speed_squared(options, grid.place(i));
      if (axis.boundary == Boundary::periodic) {  // back to where the points are, 0 < x ≤ L
        double& x = beside[static_cast<std::size_t>(a)];
        if (x < 0.5 * axis.dx()) x += axis.length;
        if (x > axis.length + 0.5 * axis.dx()) x -= axis.length;
      }
      const double there = speed_squared(options, beside);
      const bool harmonic = options.faces == VariableWave::Faces::harmonic;
      return to_axis * (harmonic ? 2 / (1 / here + 1 / there) : (here + there) / 2);
    };
    for (Index i = 0; i < n; ++i) {
      const Index here = i / stride % axis.unknowns();
      const bool first = here == 0;
      const bool last = here == axis.unknowns() - 1;
      if (!last || axis.boundary == Boundary::periodic) {
        const Index right = last ? i - here * stride : i + stride;
        const double c = face(i, axis.dx());
        for (const Entry& e : {Entry{i, i, c}, Entry{right, right, c}, Entry{i, right, -c}, Entry{right, i, -c}})
          entries.push_back(e);
      }
      if (axis.boundary != Boundary::dirichlet) continue;
      if (first) entries.push_back({i, i, face(i, -axis.dx())});
      if (last) entries.push_back({i, i, face(i, axis.dx())});
    }
  }
  return assembled(n, entries);
}

// What a case file says: VariableWave in a medium of two parts.
struct WaveCase {
  GridOptions grid = {.points = {64}, .length = {2.0}, .boundary = {Boundary::dirichlet}};
  bool is_inclusion = false;
  double speed = 1.0, second_speed = 2.0, second_size = 0.5;
  VariableWave::Faces faces = VariableWave::Faces::harmonic;
  double mass = 0.0, alpha = 1.0;
  DampingRate gamma = nullptr;
};

// c₁ beyond a plane, or in a ball; c₀ elsewhere.
std::function<double(const Place&)> medium(const WaveCase& c, const Grid& grid) {
  const double outside = c.speed;
  const double inside = c.second_speed;
  const double size = c.second_size;
  const GridAxis first = grid.axis(0);
  if (!c.is_inclusion) {
    const double plane = (1 - size) * first.length;
    return [=](const Place& x) { return x[0] > plane ? inside : outside; };
  }
  Place centre{};
  for (Index a = 0; a < grid.dimension(); ++a) centre[static_cast<std::size_t>(a)] = grid.axis(a).length / 2;
  const double radius = size * first.length / 2;
  const Index dimension = grid.dimension();
  return [=](const Place& x) {
    double distance = 0;
    for (Index a = 0; a < dimension; ++a)
      distance += square(x[static_cast<std::size_t>(a)] - centre[static_cast<std::size_t>(a)]);
    return distance < square(radius) ? inside : outside;
  };
}

}  // namespace

Problem variable_wave(const VariableWave& options) {
  if (options.grid.discretisation != Discretisation::fd2)
    throw Error(
        "waves in a medium of several parts take discretisation = fd2 alone: a higher order is lost where c jumps");
  if (options.grid.two_thirds)
    throw Error("waves in a medium of several parts have no modes to leave out; take two_thirds = false");
  const Grid grid = make_grid(options.grid);
  Problem p = second_order_problem("wave", grid, stiffness(options, grid), {});
  p.damping = rate_damping(options.gamma, grid, {false, true});
  if (options.alpha != 0) p.potential = nodal_polynomial(monomial(options.alpha / 4, 4));
  for (Index i = 0; i < grid.unknowns(); ++i) {
    double distance = 0;
    for (Index a = 0; a < grid.dimension(); ++a)
      distance += square(grid.coordinate(i, a) / grid.axis(a).length - (a == 0 ? 0.25 : 0.5));
    p.initial[i] = std::exp(-distance / square(0.07));
  }
  return p;
}

namespace {

Problem in_medium(const WaveCase& c) {
  return variable_wave({.grid = c.grid,
                        .speed = medium(c, make_grid(c.grid)),
                        .faces = c.faces,
                        .mass = c.mass,
                        .alpha = c.alpha,
                        .gamma = c.gamma});
}

}  // namespace

ProblemEntry variable_wave_entry() {
  using P = WaveCase;
  const auto positive = [](const char* name, const char* meaning) {
    return Parameter{.name = name, .meaning = meaning, .minimum = 0, .minimum_excluded = true};
  };
  Parameter discretisation = discretisation_parameter();
  discretisation.choices = {"fd2"};  // a higher order is lost where c jumps
  return ProblemRows<P>({.name = "wave",
                         .title = "Wave equation in a layered medium",
                         .equation = "u_tt + γu_t = ∇·(c(x)²∇u) − m²u − αu³",
                         .reference = "LeVeque, Finite Volume Methods for Hyperbolic Problems (2002), ch. 9",
                         .fields = {"u", "v"},
                         .meanings = {"displacement", "velocity"},
                         .default_h = "1/64",
                         .default_end = 10.0},
                        in_medium)
      .axes(&P::grid)
      .row(discretisation, [](P&, const ParameterValues&) {})
      .choice(&P::is_inclusion, {.name = "medium",
                                 .meaning = "where the second speed holds: beyond a plane, or in a ball in the middle",
                                 .choices = {"layers", "inclusion"}})
      .row(&P::speed, positive("speed", "c of the first part"))
      .row(&P::second_speed, positive("second_speed", "c of the second part"))
      .row(&P::second_size, {.name = "second_size",
                             .meaning = "width of the second part, as a fraction of the first axis",
                             .minimum = 0,
                             .maximum = 1})
      .choice(&P::faces,
              {.name = "faces", .meaning = "mean of c² between two points", .choices = {"harmonic", "arithmetic"}})
      .row(&P::mass, {.name = "mass", .meaning = "m, frequency of the mean", .minimum = 0})
      .row(&P::alpha, {.name = "alpha", .meaning = "α, strength of the cubic force"})
      .row(&P::gamma, {.name = "gamma", .default_value = "0.1", .meaning = "γ, damping rate, 1/time"})
      .preset("bump");
}

}  // namespace seiche
