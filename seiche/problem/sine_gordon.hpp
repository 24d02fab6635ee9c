// Damped sine-Gordon equation, u_tt + γu_t − κΔu + α sin u = 0, in one to three dimensions.
#pragma once

#include <seiche/problem/common/grid_options.hpp>
#include <seiche/problem/problems.hpp>

namespace seiche {

struct SineGordon {
  GridOptions grid = {.points = {256}, .length = {40.0}};
  double kappa = 1.0;  // wave speed squared
  double alpha = 1.0;
  DampingRate gamma = nullptr;      // 1/time; null: undamped
  double breather_frequency = 0.5;  // of the initial breather, in (0, 1), for κ = α = 1
};

// H = ½vᵀv − ½κ uᵀRu + α Σ(1 − cos u). Starts as the breather u = 4 atan(√(1−ω²)/ω · sin ωt / cosh(√(1−ω²)(x − L/2)))
// at t = 0 where u = 0; sine_gordon_breather is the exact solution on the line without damping. Throws Error where the
// frequency is outside (0, 1).
Problem sine_gordon(const SineGordon& options = {});
double sine_gordon_breather(double frequency, double x, double t);  // centred at x = 0

ProblemEntry sine_gordon_entry();

}  // namespace seiche
