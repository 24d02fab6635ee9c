// a y and x + a y of vectors, short ones too, by the widest registers of the machine.
#pragma once

#include <seiche/core/base/vector.hpp>

namespace seiche {

void scale(const double* y, double a, Index n, double* out);  // out = a y; out may be y
// out = x + a y; out may be x or y.
void add_scaled(const double* x, double a, const double* y, Index n, double* out);
// x ← x⁺ = x + a y; yᵀ(x + x⁺), in which x is as it was before.
double add_scaled_and_weigh(double* x, double a, const double* y, Index n);

}  // namespace seiche
