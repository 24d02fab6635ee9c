// Damped cubic nonlinear Schrödinger equation, iψ_t + ½Δψ + κ|ψ|²ψ = −iγψ, in one to three dimensions, with ψ = p + iq.
#pragma once

#include <seiche/problem/common/grid_options.hpp>
#include <seiche/problem/problems.hpp>

#include <complex>

namespace seiche {

struct Nls {
  enum class Initial { soliton, gaussian };

  GridOptions grid = {.points = {128}, .length = {40.0}, .discretisation = Discretisation::spectral};
  double kappa = 1.0;           // > 0 focusing: V is unbounded below
  DampingRate gamma = nullptr;  // of the amplitude, 1/time: Σ|ψ|² falls as e^{−2γt}; null: undamped
  double amplitude = 1.0;       // A of the initial data
  double velocity = 0.5;        // c, along the first axis
  Initial initial = Initial::soliton;
};

// H = ¼(pᵀ(−R)p + qᵀ(−R)q) − κ/4 Σ(p² + q²)², S = [[0, I], [−I, 0]], D = γI, with R ≈ Δ. Starts from the soliton across
// the first axis, or from A exp(−½|x − L/2|²) e^{ic(x−L/2)}. The damping moves what V depends on: H is promised to fall
// for κ ≤ 0 only.
Problem nls(const Nls& options = {});

// A sech(A(x − ct)) exp(i(cx + ½(A² − c²)t)) / √κ: the exact solution on the line without damping, for κ > 0 (Zakharov,
// Shabat 1972). For κ ≤ 0 the root is left out, and it is a pulse like others.
std::complex<double> nls_soliton(double kappa, double amplitude, double velocity, double x, double t);

ProblemEntry nls_entry();

}  // namespace seiche
