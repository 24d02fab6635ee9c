// How D(t) changes in time, and whether its parts commute.
#pragma once

#include <seiche/core/problem.hpp>

namespace seiche {

// P projects on fields: it commutes with the constant part unless that couples a field of P with one outside. Then
// the flow of D(t) is the product of the flows of its parts, in any order. True where one of them is missing.
bool rate_commutes(const Problem& problem);

// True if γ(t) and γ(x, t), where there are such rates, are the same at all times.
bool has_constant_rates(const LinearDamping& damping);

}  // namespace seiche
