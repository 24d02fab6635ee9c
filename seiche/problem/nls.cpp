#include <seiche/potential/modulus.hpp>
#include <seiche/problem/common/problem_rows.hpp>
#include <seiche/problem/common/wave.hpp>
#include <seiche/problem/nls.hpp>

#include <cmath>

namespace seiche {
namespace {

std::complex<double> initial_value(const Nls& options, const Grid& grid, Index point) {
  const double x = grid.coordinate(point, 0) - grid.axis(0).length / 2;
  if (options.initial == Nls::Initial::soliton)
    return nls_soliton(options.kappa, options.amplitude, options.velocity, x, 0);
  return std::polar(options.amplitude * std::exp(-squared_distance_from_centre(grid, point) / 2), options.velocity * x);
}

}  // namespace

std::complex<double> nls_soliton(double kappa, double amplitude, double velocity, double x, double t) {
  const double size = amplitude / (kappa > 0 ? std::sqrt(kappa) : 1.0) / std::cosh(amplitude * (x - velocity * t));
  return size * std::polar(1.0, velocity * x + (square(amplitude) - square(velocity)) * t / 2);
}

Problem nls(const Nls& options) {
  const Grid grid = make_grid(options.grid);
  const Stencil stiffness = -0.5 * Stencil::laplacian(grid, options.grid.discretisation);
  Problem p = wave_problem("nls", grid, stiffness, options.gamma);
  p.fields = {"p", "q"};
  p.M(1, 1) = stiffness;
  p.damping.rate_fields = {true, true};
  const Polynomial<2> w{{0, 0, -options.kappa / 4}};
  p.potential = on_grid(std::make_shared<ModulusPotential<Polynomial<2>>>(w), grid, options.grid);
  const Index n = grid.unknowns();
  for (Index i = 0; i < n; ++i) {
    const std::complex<double> psi = initial_value(options, grid, i);
    p.initial[i] = psi.real();
    p.initial[n + i] = psi.imag();
  }
  return p;
}

ProblemEntry nls_entry() {
  using P = Nls;
  return ProblemRows<P>({.name = "nls",
                         .title = "Nonlinear Schrödinger equation",
                         .equation = "iψ_t + ½Δψ + κ|ψ|²ψ = −iγψ, ψ = p + iq",
                         .reference = "Zakharov, Shabat (1972); with damping: Fibich (2001)",
                         .fields = {"p", "q"},
                         .meanings = {"real part of ψ", "imaginary part of ψ"},
                         .default_h = "1/64",
                         .default_end = 20.0},
                        nls)
      .grid(&P::grid)
      .row(&P::kappa,
           {.name = "kappa", .meaning = "κ, strength of the cubic term; positive: focusing, V unbounded below"})
      .row(&P::gamma, {.name = "gamma", .default_value = "0.05", .meaning = "γ, damping rate of the amplitude, 1/time"})
      .row(&P::amplitude, {.name = "amplitude", .meaning = "A, of the initial data"})
      .row(&P::velocity, {.name = "velocity", .meaning = "c, of the initial data along the first axis"})
      .presets(&P::initial, {"soliton", "gaussian"});
}

}  // namespace seiche
