// Sparse matrices in the exchange format of Matrix Market (Boisvert, Pozo, Remington, NISTIR 5935, 1996).
#pragma once

#include <seiche/core/grid/sparse_operators.hpp>

#include <filesystem>

namespace seiche {

// `coordinate` or `array`; `real`, `integer` or (coordinate only) `pattern`; `general`, `symmetric` or
// `skew-symmetric`. Entries at the same place add up. Throws Error with the line and what is wrong with it, or with
// both counts where they differ, and before anything is allocated where the header promises more entries than the file
// can hold.
SparseMatrix read_matrix_market(const std::filesystem::path& file);

}  // namespace seiche
