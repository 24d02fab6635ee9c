// The force of V at the initial state.
#pragma once

#include <seiche/core/problem.hpp>

namespace seiche {

// Throws Error with the field, the point and the values there where the force is not finite, as that of 1/q is at q =
// 0.
void require_finite_force(const Problem& problem);

}  // namespace seiche
