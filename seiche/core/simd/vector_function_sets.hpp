// Every set of vector functions that this processor runs: for comparisons.
#pragma once

#include <seiche/core/simd/vector_functions.hpp>

#include <vector>

namespace seiche {

// Those of the widest vectors first, and libm's last.
std::vector<VectorFunctions> all_vector_functions();

}  // namespace seiche
