#include <seiche/core/error.hpp>
#include <seiche/potential/cosine.hpp>
#include <seiche/potential/nodal.hpp>
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
  std::vector<Parameter> parameters = grid_parameters("256", "40.0");
  parameters.insert(
      parameters.end(),
      {
          {.name = "kappa", .default_value = "1.0", .meaning = "κ, wave speed squared", .minimum = 0},
          {.name = "alpha", .default_value = "1.0", .meaning = "α, strength of the pendulums"},
          {.name = "gamma", .kind = ParameterKind::rate, .default_value = "0.05", .meaning = "γ, damping rate, 1/time"},
          {.name = "breather_frequency",
           .default_value = "0.5",
           .meaning = "ω, of the initial breather, below 1",
           .minimum = 0,
           .maximum = 0.999,
           .minimum_excluded = true},
      });
  return {
      .name = "sine_gordon",
      .equation = "u_tt + γu_t − κΔu + α sin u = 0",
      .reference = "Ablowitz, Kaup, Newell, Segur (1973); with friction: McLaughlin, Scott (1978)",
      .fields = {"u", "v"},
      .meanings = {"phase", "velocity of the phase"},
      .parameters = std::move(parameters),
      .presets = {"breather"},
      .make =
          [](const ParameterValues& v, const std::string&) {
            return sine_gordon({.grid = grid_options(v),
                                .kappa = v.real("kappa"),
                                .alpha = v.real("alpha"),
                                .gamma = v.damping_rate("gamma"),
                                .breather_frequency = v.real("breather_frequency")});
          },
      .default_h = "1/64",
      .default_end = 50.0,
  };
}

}  // namespace seiche
