// x + a y of vectors, short ones too.
#pragma once

#include <seiche/core/base/vector.hpp>

namespace seiche {

// out = x + a y, by the widest vectors of the machine; out may be x or y.
void add_scaled(const double* x, double a, const double* y, Index n, double* out);
// x ← x⁺ = x + a y; yᵀ(x + x⁺), in which x is as it was before.
double add_scaled_and_weigh(double* x, double a, const double* y, Index n);

}  // namespace seiche
