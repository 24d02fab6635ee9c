// Noise that balances what sparse matrices dissipate.
#pragma once

#include <seiche/core/grid/sparse_operators.hpp>
#include <seiche/core/numerics/linear_map.hpp>
#include <seiche/noise/fluctuation.hpp>

#include <memory>

namespace seiche {

// Makes B as stated above Fluctuation, for any h: with a factor R = GGᵀ, B = √h G f(hGᵀMG)^{1/2} by Lanczos iteration,
// to ten digits. Another root than (BBᵀ)^{1/2}: noise of the same distribution, and not the same noise.
// Throws Error as `dissipation` does.
std::unique_ptr<LinearMap> sparse_noise(const SparseMatrix& S, const SparseMatrix& M, const SparseMatrix& D0, double h);

}  // namespace seiche
