#include <seiche/core/error.hpp>
#include <seiche/potential/polynomials.hpp>
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

// c₁ beyond a plane, or in a ball; c₀ elsewhere.
std::function<double(const Place&)> medium(const ParameterValues& v, const Grid& grid) {
  const double outside = v.real("speed");
  const double inside = v.real("second_speed");
  const double size = v.real("second_size");
  const GridAxis first = grid.axis(0);
  if (v.choice("medium") == "layers") {
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

Problem from_media(const ParameterValues& v, const std::string&) {
  const GridOptions grid = axes_options(v);
  const bool harmonic = v.choice("faces") == "harmonic";
  return variable_wave({.grid = grid,
                        .speed = medium(v, make_grid(grid)),
                        .faces = harmonic ? VariableWave::Faces::harmonic : VariableWave::Faces::arithmetic,
                        .mass = v.real("mass"),
                        .alpha = v.real("alpha"),
                        .gamma = v.damping_rate("gamma")});
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

ProblemEntry variable_wave_entry() {
  std::vector<Parameter> parameters;
  for (Parameter& parameter : axes_parameters("64", "2.0")) {
    if (parameter.name == "boundary") parameter.default_value = "dirichlet";
    parameters.push_back(std::move(parameter));
  }
  parameters.push_back(discretisation_parameter());
  parameters.back().choices = {"fd2"};  // a higher order is lost where c jumps
  const auto speed = [](const char* name, const char* value, const char* meaning) {
    return Parameter{.name = name, .default_value = value, .meaning = meaning, .minimum = 0, .minimum_excluded = true};
  };
  parameters.insert(
      parameters.end(),
      {
          {.name = "medium",
           .kind = ParameterKind::choice,
           .default_value = "layers",
           .meaning = "where the second speed holds: beyond a plane, or in a ball in the middle",
           .choices = {"layers", "inclusion"}},
          speed("speed", "1.0", "c of the first part"),
          speed("second_speed", "2.0", "c of the second part"),
          {.name = "second_size",
           .default_value = "0.5",
           .meaning = "width of the second part, as a fraction of the first axis",
           .minimum = 0,
           .maximum = 1},
          {.name = "faces",
           .kind = ParameterKind::choice,
           .default_value = "harmonic",
           .meaning = "mean of c² between two points",
           .choices = {"harmonic", "arithmetic"}},
          {.name = "mass", .default_value = "0.0", .meaning = "m, frequency of the mean", .minimum = 0},
          {.name = "alpha", .default_value = "1.0", .meaning = "α, strength of the cubic force"},
          {.name = "gamma", .kind = ParameterKind::rate, .default_value = "0.1", .meaning = "γ, damping rate, 1/time"},
      });
  return {
      .name = "wave",
      .equation = "u_tt + γu_t = ∇·(c(x)²∇u) − m²u − αu³",
      .reference = "LeVeque, Finite Volume Methods for Hyperbolic Problems (2002), ch. 9",
      .fields = {"u", "v"},
      .meanings = {"displacement", "velocity"},
      .parameters = std::move(parameters),
      .presets = {"bump"},
      .make = from_media,
      .default_h = "1/64",
      .default_end = 10.0,
  };
}

}  // namespace seiche
