// Sparse matrices in the exchange format of Matrix Market (Boisvert, Pozo, Remington, NISTIR 5935, 1996).
#pragma once

#include <seiche/config/data/matrix_file.hpp>

namespace seiche {

// `coordinate` or `array`; `real`, `integer` or (coordinate only) `pattern`; `general`, `symmetric` or
// `skew-symmetric`. Otherwise as read_matrix and matrix_sizes; what is wrong is said with its line.
SparseMatrix read_matrix_market(const std::filesystem::path& file, bool* repeats = nullptr);
MatrixSizes matrix_market_sizes(const std::filesystem::path& file);

}  // namespace seiche
