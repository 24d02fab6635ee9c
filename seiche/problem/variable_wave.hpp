// Waves in a medium of several parts, u_tt + γu_t = ∇·(c(x)²∇u) − m²u − αu³, in one to three dimensions.
#pragma once

#include <seiche/core/damping_rate.hpp>
#include <seiche/problem/common/grid_options.hpp>
#include <seiche/problem/problems.hpp>

#include <array>
#include <functional>

namespace seiche {

struct VariableWave {
  enum class Faces { harmonic, arithmetic };  // mean of c² between two points: harmonic is exact for layers
  GridOptions grid = {.points = {64}, .length = {2.0}, .boundary = {Boundary::dirichlet}};  // differences of order two
  std::function<double(const std::array<double, 3>& x)> speed = nullptr;                    // c(x) > 0; null: 1
  Faces faces = Faces::harmonic;
  double mass = 0.0;   // m
  double alpha = 0.0;  // strength of the cubic force
  DampingRate gamma = nullptr;
};

// H = ½vᵀv + ½uᵀ(m²I − ∇·c²∇)u + α/4 Σu⁴, S = [[0, I], [−I, 0]], D = diag(0, γI); at rest, with a bump at a quarter of
// the first axis. Throws Error where c is not positive, and where the grid asks for a discretisation other than fd2 or
// for the two-thirds rule.
Problem variable_wave(const VariableWave& options = {});

ProblemEntry variable_wave_entry();

}  // namespace seiche
