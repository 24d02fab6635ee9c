#include <seiche/core/error.hpp>
#include <seiche/potential/polynomials.hpp>
#include <seiche/problem/alpha_fpu.hpp>
#include <seiche/problem/common/grid_options.hpp>
#include <seiche/problem/common/wave.hpp>

#include <cmath>

namespace seiche {
namespace {

// ln(1 + eˣ) without overflow
double softplus(double x) { return x > 0 ? x + std::log1p(std::exp(-x)) : std::log1p(std::exp(x)); }

// The paper's data at t = 0 with α = 0.1, a function of the grid index j; it does not vanish at j = N.
double paper_displacement(Index j) {
  const double a = 2 * 0.1;
  const auto term = [&](double shift) { return softplus(a * (static_cast<double>(j) - shift)); };
  return 5 * (term(97) + term(32) - term(96) - term(33));
}

}  // namespace

Problem alpha_fpu(const AlphaFpu& options) {
  const Grid grid{.axes = {{options.points, options.length, Boundary::dirichlet}}};
  const double dx = grid.axis(0).dx();
  const Stencil R = Stencil::laplacian(grid);
  Problem p = wave_problem("alpha_fpu", grid, Stencil::identity(square(options.mass)) + -1.0 * R, options.gamma);
  p.damping.constant(1, 1) = -options.beta * R;

  const bool dissipative = options.formulation == AlphaFpu::Formulation::dissipative;
  if (dissipative && p.damping.field_rate) {
    throw Error(
        "formulation = \"dissipative\" puts gamma into S, but gamma = {} changes from point to point; use "
        "formulation = \"conservative\"",
        p.damping.field_rate->text());
  }
  if (dissipative && p.damping.rate) {
    if (!p.damping.rate->is_constant()) {
      throw Error(
          "formulation = \"dissipative\" puts gamma into the constant S, but gamma = {} varies with time; use "
          "formulation = \"conservative\"",
          p.damping.rate->text());
    }
    p.S(1, 1) = Stencil::identity(-p.damping.rate->value(0));
    p.damping.rate = nullptr;
  }

  const int k = options.exponent;
  const double strength = options.epsilon / (std::pow(dx, k + 2) * (k + 1) * (k + 2));
  p.potential = bond_polynomial(monomial(strength, k + 2), grid.axis(0).boundary);

  for (Index i = 0; i < grid.unknowns(); ++i) p.initial[i] = paper_displacement(i + 1);
  return p;
}

ProblemEntry alpha_fpu_entry() {
  return {
      .name = "alpha_fpu",
      .equation = "u_tt − βu_xxt − (1 + εu_xᵏ)u_xx + m²u + γu_t = 0, u = 0 at both ends",
      .reference = "Li, Li, Shang, Xu, Example 2; Macías-Díaz (2009)",
      .fields = {"u", "v"},
      .meanings = {"displacement", "velocity"},
      .parameters =
          {
              {.name = "length",
               .default_value = "2.0",
               .meaning = "L, where the chain ends",
               .minimum = 0,
               .minimum_excluded = true},
              {.name = "points",
               .kind = ParameterKind::integer,
               .default_value = "20",
               .meaning = "N, grid intervals; N − 1 unknowns per field",
               .minimum = 2,
               .maximum = most_intervals},
              {.name = "exponent",
               .kind = ParameterKind::integer,
               .default_value = "1",
               .meaning = "k, power of u_x in the stress",
               .minimum = 1,
               .maximum = max_polynomial_degree - 2},
              {.name = "epsilon", .default_value = "0.005", .meaning = "ε, strength of the nonlinear stress"},
              {.name = "beta",
               .default_value = "0.01",
               .meaning = "β, Kelvin–Voigt damping, length²/time",
               .minimum = 0},
              {.name = "gamma",
               .kind = ParameterKind::rate,
               .default_value = "0.5",
               .meaning = "γ, damping rate, 1/time"},
              {.name = "mass", .default_value = "1.0", .meaning = "m, frequency of the mean"},
              {.name = "formulation",
               .kind = ParameterKind::choice,
               .default_value = "conservative",
               .meaning = "γ in D (conservative, Example 2.1) or in S (dissipative, Example 2.2)",
               .choices = {"conservative", "dissipative"}},
          },
      .presets = {"paper"},
      .make =
          [](const ParameterValues& v, const std::string&) {
            using enum AlphaFpu::Formulation;
            return alpha_fpu({.length = v.real("length"),
                              .points = v.integer("points"),
                              .exponent = static_cast<int>(v.integer("exponent")),
                              .epsilon = v.real("epsilon"),
                              .beta = v.real("beta"),
                              .gamma = v.damping_rate("gamma"),
                              .mass = v.real("mass"),
                              .formulation = v.choice("formulation") == "dissipative" ? dissipative : conservative});
          },
      .default_h = "1/256",
      .default_end = 50.0,
  };
}

}  // namespace seiche
