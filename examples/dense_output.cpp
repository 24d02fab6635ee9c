// A run by tolerance and its solution at any time: steps as long as they may be, and z(t) wherever it is asked for.
// An oscillator without a potential, q'' + 0.2q' + q = 0, has a solution to compare with.
#include <seiche/seiche.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

int main() {
  const auto problem = seiche::oscillator({.omega_squared = 1.0, .alpha = 0.0, .gamma = seiche::constant_rate(0.2)});
  const auto solution =
      seiche::solve(problem, {.method = "etdrk4", .tolerance = 1e-8, .h_max = 0.5, .t_end = 20, .dense_output = true});
  const double omega = std::sqrt(1 - 0.01);
  double worst = 0;
  for (double t = 0; t <= 20; t += 0.01) {
    std::array<double, 2> z{};
    solution.sol->evaluate({&t, 1}, z);
    const double q = std::exp(-0.1 * t) * (std::cos(omega * t) + 0.1 / omega * std::sin(omega * t));
    worst = std::max(worst, std::abs(z[0] - q));
  }
  std::printf("the error between steps is %s the tolerance\n", worst <= 1e-8 ? "within" : "beyond");
}
// It prints:
//   the error between steps is within the tolerance
