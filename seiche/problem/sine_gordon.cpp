#include <seiche/core/base/error.hpp>
#include <seiche/potential/cosine.hpp>
#include <seiche/potential/nodal.hpp>
#include <seiche/problem/common/problem_rows.hpp>
#include <seiche/problem/common/wave.hpp>
#include <seiche/problem/sine_gordon.hpp>

#include <cmath>
#include <utility>

namespace seiche {

double sine_gordon_breather(double frequency, double x, double t) {
  const double width = std::sqrt(1 - square(frequency));
  return 4 * std::atan(width / frequency * std::sin(frequency * t) / std::cosh(width * x));
}

Problem sine_gordon(const SineGordon& options) {
  if (!(options.breather_frequency > 0 && options.breather_frequency < 1))
    throw Error("breather_frequency = {} must be between 0 and 1, where a breather decays along the line",
                options.breather_frequency);
  const Grid grid = make_grid(options.grid);
  const Stencil stiffness = -options.kappa * Stencil::laplacian(grid, options.grid.discretisation);
  Problem p = wave_problem("sine_gordon", grid, stiffness, options.gamma);
  p.potential = on_grid(std::make_shared<NodalPotential<Cosine>>(Cosine{options.alpha}), grid, options.grid);
  const double width = std::sqrt(1 - square(options.breather_frequency));
  const double middle = grid.axis(0).length / 2;
  p.initial.tail(grid.unknowns()) =
      sample(grid, [&](double x) { return 4 * width / std::cosh(width * (x - middle)); });  // ∂u/∂t at t = 0
  return p;
}

ProblemEntry sine_gordon_entry() {
  using P = SineGordon;
  return ProblemRows<P>({.name = "sine_gordon",
                         .title = "Sine-Gordon equation",
                         .equation = "u_tt + γu_t − κΔu + α sin u = 0",
                         .reference = "Ablowitz, Kaup, Newell, Segur (1973); with friction: McLaughlin, Scott (1978)",
                         .fields = {"u", "v"},
                         .meanings = {"phase", "velocity of the phase"},
                         .default_h = "1/64",
                         .default_end = 50.0},
                        sine_gordon)
      .grid(&P::grid)
      .row(&P::kappa, {.name = "kappa", .meaning = "κ, wave speed squared", .minimum = 0})
      .row(&P::alpha, {.name = "alpha", .meaning = "α, strength of the pendulums"})
      .row(&P::gamma, {.name = "gamma", .default_value = "0.05", .meaning = "γ, damping rate, 1/time"})
      .row(&P::breather_frequency, {.name = "breather_frequency",
                                    .meaning = "ω, of the initial breather, below 1",
                                    .minimum = 0,
                                    .maximum = 0.999,
                                    .minimum_excluded = true})
      .preset("breather");
}

}  // namespace seiche
