// Lengths of vectors.
#pragma once

#include <seiche/core/base/vector.hpp>

namespace seiche {

// |x|² in a fixed order of sums, by the widest vectors of the machine. NaN and ∞ where x holds them.
double squared_norm(const double* x, Index n);

}  // namespace seiche
