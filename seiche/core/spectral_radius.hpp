// The largest modulus of the eigenvalues of a linear map of states.
#pragma once

#include <seiche/core/base/function_ref.hpp>
#include <seiche/core/system.hpp>

namespace seiche {

// By power iteration, from below. `apply` replaces a state by its image; by two of them at a time, since the
// eigenvalues of SM − D come in pairs ±iω.
double spectral_radius(const Space& space, FunctionRef<void(Vector& z)> apply);

// Of L = SM − D₀: the fastest rate of the linear flow.
double rate_of_linear_flow(const System& system);

}  // namespace seiche
