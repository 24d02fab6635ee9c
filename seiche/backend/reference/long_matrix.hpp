// Full matrices in extended precision, and their φ-functions by the definition.
#pragma once

#include <seiche/core/base/vector.hpp>

#include <Eigen/Core>

#include <vector>

namespace seiche {

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

inline LongMatrix long_identity(Index size) { return LongMatrix::Identity(size, size); }

// How often A is halved until ‖A‖₁ ≤ 2. Throws Error where that is so often that fewer than ten digits would be left.
int reference_halvings(const LongMatrix& A);

// e^A − I, φ₁(A), … φ_order(A), and φ₁ in any case, of a matrix halved so often: the last by its series
// Σ_j Aʲ/(j + order)!, the others from φ_k = Aφ_{k+1} + I/k!. Then doublings
//   φ_k(2A) = 2^{−k}[e^Aφ_k(A) + Σ_{1≤l≤k} φ_l(A)/(k − l)!].
std::vector<LongMatrix> reference_phi_functions(const LongMatrix& A, Index order);

}  // namespace seiche
