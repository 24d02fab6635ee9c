#include <seiche/core/error.hpp>
#include <seiche/potential/polynomials.hpp>
#include <seiche/problem/common/grid_options.hpp>
#include <seiche/problem/common/second_order.hpp>
#include <seiche/problem/common/wave.hpp>
#include <seiche/problem/oscillator.hpp>

#include <algorithm>

namespace seiche {

Problem oscillator(const Oscillator& options) {
  const Grid grid = points_without_place(options.points);
  Problem p = wave_problem("oscillator", grid, Stencil::identity(std::max(options.omega_squared, 0.0)), options.gamma);
  p.fields = {"q", "p"};
  std::vector<double> w = monomial(options.alpha / 4, 4);
  if (options.omega_squared < 0) {
    w[2] = options.omega_squared / 2;
    p.notes.push_back(
        fmt::format("omega_squared = {} < 0: ½ω²q² was moved from M into V, so that M ⪰ 0", options.omega_squared));
  }
  p.potential = nodal_polynomial(w);
  for (Index i = 0; i < options.points; ++i) p.initial[i] = 1 / static_cast<double>(i + 1);
  return p;
}

ProblemEntry oscillator_entry() {
  return {
      .name = "oscillator",
      .equation = "q̈ + γq̇ + ω²q + αq³ = 0",
      .reference = "Duffing (1918)",
      .fields = {"q", "p"},
      .meanings = {"displacement", "momentum"},
      .parameters =
          {
              {.name = "points",
               .kind = ParameterKind::integer,
               .default_value = "1",
               .meaning = "number of oscillators, which do not touch",
               .minimum = 1,
               .maximum = most_intervals},
              {.name = "omega_squared",
               .default_value = "1.0",
               .meaning = "ω², frequency squared; negative: a double well"},
              {.name = "alpha", .default_value = "1.0", .meaning = "α, strength of the cubic force"},
              {.name = "gamma",
               .kind = ParameterKind::rate,
               .default_value = "0.1",
               .meaning = "γ, damping rate, 1/time"},
          },
      .presets = {"release"},
      .make =
          [](const ParameterValues& v, const std::string&) {
            return oscillator({.points = v.integer("points"),
                               .omega_squared = v.real("omega_squared"),
                               .alpha = v.real("alpha"),
                               .gamma = v.damping_rate("gamma")});
          },
      .default_h = "1/64",
      .default_end = 50.0,
  };
}

}  // namespace seiche
