// Balancing of a sparse matrix by a diagonal similarity.
#pragma once

#include <seiche/core/grid/sparse_operators.hpp>

namespace seiche {

// d of powers of two with row and column sums of D⁻¹AD, D = diag d, about equal off the diagonal (Osborne 1960; Parlett
// & Reinsch 1969): the norm of a wave system [0, I; −A, 0] falls from ‖A‖ to its largest frequency √‖A‖. A: square.
Vector balancing_scales(const SparseMatrix& A);

}  // namespace seiche
