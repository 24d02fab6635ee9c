// Masses in a row, with springs and dashpots between neighbours and to the ground:
//   mü_j = k d_j + k₃ d_j³ − (the same one bond to the left) − g u_j − g₃ u_j³ − mγu̇_j + mν(u̇_{j+1} − 2u̇_j +
//   u̇_{j−1}),
// with d_j = u_{j+1} − u_j.
#pragma once

#include <seiche/core/grid/grid.hpp>
#include <seiche/problem/problems.hpp>

namespace seiche {

struct Chain {
  enum class Initial { kick, first_mode };

  Index points = 32;                        // N masses on a ring or with free ends, N − 1 between fixed ends
  Boundary boundary = Boundary::dirichlet;  // fixed ends; periodic: a ring; neumann: free ends
  double mass = 1.0;                        // m
  double neighbour_spring = 1.0;            // k, ≥ 0
  double neighbour_cubic = 0.0;             // k₃
  double ground_spring = 0.0;               // g, ≥ 0
  double ground_cubic = 0.0;                // g₃
  double neighbour_damping = 0.0;           // ν, dashpots between neighbours over m, 1/time, ≥ 0
  DampingRate gamma = nullptr;              // γ, dashpots to the ground over m, 1/time; null: none
  Initial initial = Initial::kick;
  double amplitude = 1.0;  // of the initial data: velocity of the kicked mass, or displacement of the first mode
};

// z = (u, p) with p = mu̇, H = Σ p²/2m + ½uᵀ(gI − kR)u + Σ k₃d⁴/4 + g₃u⁴/4, S = [[0, I], [−I, 0]], D = diag(0, γI −
// νR), with R the second difference. Starts at rest but for the middle mass (kick), or at rest in the first mode,
// sin(πj/N) between fixed ends, sin(2πj/N) on a ring and cos(π(j − ½)/N) with free ends.
Problem chain(const Chain& options = {});

ProblemEntry chain_entry();

// The ends as a parameter of a case file, and back.
Parameter chain_boundary_parameter(const std::string& default_value);
Boundary chain_boundary(const ParameterValues& values);

}  // namespace seiche
