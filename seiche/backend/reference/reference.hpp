// The reference backend, what all others are compared with: each letter of the equation by its definition, with full
// matrices in extended precision, and nothing fused. Slow, short, right.
#pragma once

#include <seiche/core/system.hpp>

namespace seiche {

// Its own: propagators, φ-functions and their forms, the damping and its flow, friction, V and its gradients. Shared
// with all backends, since the problem states them: S, M and D as matrices; the functions V, ∇V, γ and R; Taylor
// coefficients of V, and mean gradients but of polynomials of one field. Shared with the dense backend: the space,
// external forces and S(z) at the points, V = 0, and the damping's estimates of rates and of errors of quadratures.
// Throws Error above dense_limit unknowns, and where h‖L‖ is so large that exponentials would have fewer than ten
// digits left.
System reference_system(const Problem& problem, const BackendOptions& options = {});

}  // namespace seiche
