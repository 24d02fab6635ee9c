// Oscillators on the nodes of a graph, ü_i + γu̇_i + ω²u_i + κΣ_j w_ij(u_i − u_j) + αu_i³ = 0.
#pragma once

#include <seiche/core/damping_rate.hpp>
#include <seiche/problem/problems.hpp>

#include <cstdint>

namespace seiche {

// A ring where each of `count` nodes is joined to its `neighbours` next ones, and `shortcuts` more edges between nodes
// drawn by a generator of its own from `seed`: the same graph on every machine (Newman and Watts 1999). Adjacency
// matrix.
SparseMatrix small_world(Index count, Index neighbours, Index shortcuts, std::uint64_t seed);

struct Network {
  SparseMatrix adjacency = small_world(20, 2, 6, 1);  // w_ij ≥ 0, symmetric, diagonal ignored
  double coupling = 1.0;                              // κ
  double omega_squared = 0.2;                         // ≥ 0
  double alpha = 1.0;
  DampingRate gamma = nullptr;
};

// H = ½vᵀv + ½uᵀ(ω²I + κL)u + α/4 Σu⁴ with the graph's Laplacian L; at rest, with node 1 displaced by 1. Throws Error
// where the graph has no node, or a weight is negative or has no counterpart.
Problem network(const Network& options = {});

ProblemEntry network_entry();

}  // namespace seiche
