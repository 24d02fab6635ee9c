#include <seiche/potential/polynomials.hpp>
#include <seiche/problem/common/problem_rows.hpp>
#include <seiche/problem/common/wave.hpp>
#include <seiche/problem/gkdv.hpp>

#include <cmath>

namespace seiche {

Problem gkdv(const Gkdv& options) {
  Problem p;
  p.name = "gkdv";
  p.grid.axes = {{options.points, options.length, Boundary::periodic}};
  p.fields = {"u"};
  p.S = BlockStencil(1);
  p.S(0, 0) = Stencil::derivative(p.grid, 0, options.discretisation);
  p.M = BlockStencil(1);
  p.M(0, 0) = -options.epsilon * Stencil::laplacian(p.grid, options.discretisation);
  p.damping = rate_damping(options.mu, p.grid, {true});
  const int k = options.exponent;
  p.potential = on_grid(nodal_polynomial(monomial(-options.sigma / (k + 2), k + 2)), p.grid,
                        {.discretisation = options.discretisation, .two_thirds = options.two_thirds});
  p.initial = sample(p.grid, [&](double x) { return 0.4 * std::exp(-square(x - options.length / 2) / 2); });
  return p;
}

ProblemEntry gkdv_entry() {
  using P = Gkdv;
  return ProblemRows<P>({.name = "gkdv",
                         .title = "Generalised Korteweg–de Vries equation",
                         .equation = "u_t + εu_xxx + ∂_x(σu^{k+1}) + μu = 0, periodic",
                         .reference = "Li, Li, Shang, Xu, Example 3; Ali et al. (2017)",
                         .fields = {"u"},
                         .meanings = {"elevation"},
                         .default_h = "1/512",
                         .default_end = 50.0},
                        gkdv)
      .row(&P::length, {.name = "length", .meaning = "L, the period in x", .minimum = 0, .minimum_excluded = true})
      .row(&P::points,
           {.name = "points", .meaning = "N, grid points in one period", .minimum = 3, .maximum = most_intervals})
      .row(discretisation_parameter(), [](P& p, const ParameterValues& v) { p.discretisation = discretisation_of(v); })
      .row(dealias_parameter(), [](P& p, const ParameterValues& v) { p.two_thirds = two_thirds_of(v); })
      .row(&P::exponent, {.name = "exponent",
                          .meaning = "k, power of the nonlinearity",
                          .minimum = 1,
                          .maximum = max_polynomial_degree - 2})
      .row(&P::sigma, {.name = "sigma", .meaning = "σ, strength of the nonlinearity; positive: V unbounded below"})
      .row(&P::epsilon, {.name = "epsilon", .meaning = "ε, dispersion", .minimum = 0})
      .row(&P::mu, {.name = "mu", .default_value = "0.5", .meaning = "μ, damping rate, 1/time"})
      .preset("paper");
}

}  // namespace seiche
