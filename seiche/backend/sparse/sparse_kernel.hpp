// The kernel of a sparse matrix.
#pragma once

#include <seiche/core/grid/sparse_operators.hpp>

namespace seiche {

inline constexpr Index qr_limit =
    4000;  // unknowns: a ring of differences then takes seconds, and of four times as many minutes
inline constexpr Index kernel_limit = 200'000;
inline constexpr Index most_of_large_kernel = 32;  // dimensions beyond qr_limit

// Orthonormal columns that span ker A, none where A has none. A with one entry in each row and each column, as of q' =
// p, p' = −q, needs no arithmetic. Any other takes a rank-revealing QR decomposition of Aᵀ, whose rows in R count as
// zero below 1e-12 of the largest column of Aᵀ; and beyond qr_limit unknowns inverse iteration with AᵀA, where a vector
// v of length one counts as of the kernel if |Av| is below 1e-9 of the largest column. No column is returned, whatever
// ker A, beyond kernel_limit unknowns, and of a large A that has more than most_of_large_kernel, or singular values
// between 1e-9 and 1e-5 of the largest column, or more than 64 entries of AᵀA a row. A: square.
SparseMatrix sparse_kernel(const SparseMatrix& A);

}  // namespace seiche
