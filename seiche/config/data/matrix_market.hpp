// Sparse matrices in the exchange format of Matrix Market (Boisvert, Pozo, Remington, NISTIR 5935, 1996).
#pragma once

#include <seiche/core/grid/sparse_operators.hpp>

#include <filesystem>

namespace seiche {

// `coordinate` or `array`; `real`, `integer` or (coordinate only) `pattern`; `general`, `symmetric` or
// `skew-symmetric`. Entries at the same place add up, and `repeats` tells that there are such. Throws Error with the
// line and what is wrong with it, or with both counts where they differ, and before anything is allocated where the
// header promises more entries than the file can hold, or more rows than the memory.
SparseMatrix read_matrix_market(const std::filesystem::path& file, bool* repeats = nullptr);

struct MatrixSizes {
  Index rows = 0, columns = 0;
  Index entries = 0;  // in the file
};

// What the header says; nothing behind it is read.
MatrixSizes matrix_market_sizes(const std::filesystem::path& file);

}  // namespace seiche
