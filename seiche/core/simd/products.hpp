// Products of vectors, by the widest registers of the machine, in an order of sums that depends on lengths alone. NaN
// and ∞ where the vectors hold them.
#pragma once

#include <seiche/core/base/value_and_magnitude.hpp>
#include <seiche/core/base/vector.hpp>

namespace seiche {

double squared_norm(const double* x, Index n);                                   // |x|²
double dot(const double* x, const double* y, Index n);                           // xᵀy
ValueAndMagnitude dot_and_magnitude(const double* x, const double* y, Index n);  // and |x|ᵀ|y|

}  // namespace seiche
