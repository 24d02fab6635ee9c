// V whose value several processes compute together.
#pragma once

#include <seiche/core/potential.hpp>
#include <seiche/core/space.hpp>
#include <seiche/petsc/ts_functions.hpp>

#include <memory>
#include <string>

namespace seiche {

// V of `functions` on their support, which comes first in z; V = 0 where they have none. `space` outlives it. Mean
// gradients as those of own_potential.
std::unique_ptr<Potential> joint_potential(std::shared_ptr<const TsFunctions> functions, const Space& space);

// As gradient_complaint of own_potential, along three directions at random from the part z of a state.
std::string gradient_complaint(const TsFunctions& functions, const Space& space, const Vector& z);

}  // namespace seiche
