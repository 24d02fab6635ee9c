// The kernel of a full matrix.
#pragma once

#include <seiche/core/base/vector.hpp>

#include <Eigen/Core>

namespace seiche {

// Orthonormal columns, of real or complex matrices. Singular vectors by the eigenvectors of SᴴS, each tried on S
// itself: the smallest eigenvalues are round-off. In units in which the largest entries of columns and rows are 1:
// fields have units of their own, and γ beside 1 may be 10³⁰ in others.
template <class Matrix>
Matrix dense_kernel(const Matrix& S);

}  // namespace seiche
