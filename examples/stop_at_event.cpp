// An event that ends the run: a damped oscillator until its amplitude has come down to a tenth.
// g changes its sign at the event, which is found to round-off inside a step; `direction` says which changes count.
#include <seiche/seiche.hpp>

#include <cstdio>

int main() {
  const auto duffing = seiche::oscillator({.omega_squared = 1.0, .alpha = 1.0, .gamma = seiche::constant_rate(0.2)});
  const auto solution =
      seiche::solve(duffing, {.method = "egc6",
                              .tolerance = 1e-10,
                              .t_end = 100,
                              .events = {{.g = [](double, const seiche::Vector& z) { return z.squaredNorm() - 0.01; },
                                          .direction = seiche::Event::Direction::falling,
                                          .ends_at = 1}}});
  std::printf("%s\n", solution.ended_by_event ? "ended by the event" : "ran to the end");
  std::printf("t = %.6f, q = %.6f, p = %.6f\n", solution.t.back(), solution.events[0].z[0], solution.events[0].z[1]);
}
// It prints:
//   ended by the event
//   t = 24.584492, q = 0.037739, p = -0.092605
