#include <seiche/core/base/error.hpp>
#include <seiche/potential/polynomials.hpp>
#include <seiche/problem/common/problem_rows.hpp>
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
  using P = Oscillator;
  return ProblemRows<P>({.name = "oscillator",
                         .title = "Duffing oscillator",
                         .equation = "q̈ + γq̇ + ω²q + αq³ = 0",
                         .reference = "Duffing (1918)",
                         .fields = {"q", "p"},
                         .meanings = {"displacement", "momentum"},
                         .default_h = "1/64",
                         .default_end = 50.0},
                        oscillator)
      .row(&P::points, {.name = "points",
                        .meaning = "number of oscillators, which do not touch",
                        .minimum = 1,
                        .maximum = most_intervals})
      .row(&P::omega_squared, {.name = "omega_squared", .meaning = "ω², frequency squared; negative: a double well"})
      .row(&P::alpha, {.name = "alpha", .meaning = "α, strength of the cubic force"})
      .row(&P::gamma, {.name = "gamma", .default_value = "0.1", .meaning = "γ, damping rate, 1/time"})
      .preset("release");
}

}  // namespace seiche
