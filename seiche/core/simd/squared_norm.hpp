// Lengths of vectors.
#pragma once

#include <seiche/core/base/vector.hpp>

namespace seiche {

// |z|² in a fixed order of sums, by the widest vectors of the machine. NaN and ∞ where z holds them.
double squared_norm(const Vector& z);

}  // namespace seiche
