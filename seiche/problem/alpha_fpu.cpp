#include <seiche/core/base/error.hpp>
#include <seiche/potential/polynomials.hpp>
#include <seiche/problem/alpha_fpu.hpp>
#include <seiche/problem/common/problem_rows.hpp>
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
  using P = AlphaFpu;
  return ProblemRows<P>({.name = "alpha_fpu",
                         .title = "α-FPU equation",
                         .equation = "u_tt − βu_xxt − (1 + εu_xᵏ)u_xx + m²u + γu_t = 0, u = 0 at both ends",
                         .reference = "Li, Li, Shang, Xu, Example 2; Macías-Díaz (2009)",
                         .fields = {"u", "v"},
                         .meanings = {"displacement", "velocity"},
                         .default_h = "1/256",
                         .default_end = 50.0},
                        alpha_fpu)
      .row(&P::length, {.name = "length", .meaning = "L, where the chain ends", .minimum = 0, .minimum_excluded = true})
      .row(&P::points, {.name = "points",
                        .meaning = "N, grid intervals; N − 1 unknowns per field",
                        .minimum = 2,
                        .maximum = most_intervals})
      .row(&P::exponent, {.name = "exponent",
                          .meaning = "k, power of u_x in the stress",
                          .minimum = 1,
                          .maximum = max_polynomial_degree - 2})
      .row(&P::epsilon, {.name = "epsilon", .meaning = "ε, strength of the nonlinear stress"})
      .row(&P::beta, {.name = "beta", .meaning = "β, Kelvin–Voigt damping, length²/time", .minimum = 0})
      .row(&P::gamma, {.name = "gamma", .default_value = "0.5", .meaning = "γ, damping rate, 1/time"})
      .row(&P::mass, {.name = "mass", .meaning = "m, frequency of the mean"})
      .choice(&P::formulation, {.name = "formulation",
                                .meaning = "γ in D (conservative, Example 2.1) or in S (dissipative, Example 2.2)",
                                .choices = {"conservative", "dissipative"}})
      .preset("paper");
}

}  // namespace seiche
