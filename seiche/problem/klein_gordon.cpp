#include <seiche/core/base/error.hpp>
#include <seiche/potential/polynomials.hpp>
#include <seiche/problem/common/problem_rows.hpp>
#include <seiche/problem/common/wave.hpp>
#include <seiche/problem/klein_gordon.hpp>

#include <cmath>
#include <numbers>

namespace seiche {

Problem klein_gordon(const KleinGordon& options) {
  const Grid grid = make_grid(options.grid);
  const double bound = std::max(options.omega_squared, 0.0);
  const Stencil stiffness =
      Stencil::identity(bound) + -options.kappa * Stencil::laplacian(grid, options.grid.discretisation);
  Problem p = wave_problem("klein_gordon", grid, stiffness, options.gamma);

  std::vector<double> w = monomial(options.alpha / 4, 4);
  if (options.omega_squared < 0) {
    w[2] = options.omega_squared / 2;
    p.notes.push_back(
        fmt::format("omega_squared = {} < 0: ½ω²u² was moved from M into V, so that M ⪰ 0", options.omega_squared));
  }
  p.potential = on_grid(nodal_polynomial(w), grid, options.grid);

  using std::numbers::sqrt2;
  const double sqrt5 = std::sqrt(5.0);
  p.initial << sample(grid, [&](double x) { return std::tanh(sqrt2 * x) / sqrt5; }),
      sample(grid, [&](double x) { return -3 * sqrt2 / (10 * sqrt5) / square(std::cosh(sqrt2 * x)); });
  return p;
}

ProblemEntry klein_gordon_entry() {
  using P = KleinGordon;
  return ProblemRows<P>({.name = "klein_gordon",
                         .title = "Klein–Gordon equation",
                         .equation = "u_tt + γu_t − κΔu + ω²u + αu³ = 0",
                         .reference = "Li, Li, Shang, Xu, Example 1; Côte et al. (2021)",
                         .fields = {"u", "v"},
                         .meanings = {"displacement", "velocity"},
                         .default_h = "1/256",
                         .default_end = 50.0},
                        klein_gordon)
      .grid(&P::grid)
      .row(&P::kappa, {.name = "kappa", .meaning = "κ, wave speed squared", .minimum = 0})
      .row(&P::omega_squared,
           {.name = "omega_squared", .meaning = "ω², frequency squared of the mean; negative: a double well"})
      .row(&P::alpha,
           {.name = "alpha", .meaning = "α, strength of the cubic force; negative: focusing, V unbounded below"})
      .row(&P::gamma, {.name = "gamma", .default_value = "0.1", .meaning = "γ, damping rate, 1/time"})
      .preset("paper");
}

}  // namespace seiche
