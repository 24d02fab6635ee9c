#include <seiche/seiche.hpp>

#include <cstdio>

int main() {
  const auto wave = seiche::klein_gordon(
      {.grid = {.points = {64}, .length = {2.0}}, .alpha = 1.0, .gamma = seiche::constant_rate(0.1)});
  seiche::Simulation simulation(wave, {.method = "seisav"});
  for (int n = 0; n < 1000; ++n) {
    if (!simulation.step(0.01).solved()) return 1;
  }
  std::printf("Seiche %s: H(%g) = %.12g\n", seiche::version_number.data(), simulation.state().t, simulation.energy().H);
}
