// The kernel of a sparse matrix.
#pragma once

#include <seiche/core/sparse_operators.hpp>

namespace seiche {

inline constexpr Index kernel_limit =
    4000;  // unknowns: a ring of differences then takes seconds, and of four times as many minutes

// Orthonormal columns that span ker A, none where A has none. A with one entry in each row and each column, as of q' = p,
// p' = −q, needs no arithmetic; any other takes a rank-revealing QR decomposition of Aᵀ, whose rows in R count as zero below
// 1e-12 of the largest column of Aᵀ, and is not looked at beyond kernel_limit unknowns: then no column is returned. A: square.
SparseMatrix sparse_kernel(const SparseMatrix& A);

}  // namespace seiche
