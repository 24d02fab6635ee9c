// Strang splitting between the damped linear flow and the rest.
#pragma once

#include <seiche/core/system.hpp>
#include <seiche/method/projection/base_step.hpp>

#include <memory>

namespace seiche {

// e^{hL/2}, ż = N(z) for h, e^{hL/2}, with L = SM − D₀ and N(z) = S∇V(z) − (D − D₀)z, D taken at the middle of the
// step: order two. The flow of N is a kick where S∇V moves momenta alone and D is D₀, and the explicit midpoint rule
// elsewhere. `system` and `phi` outlive it.
std::unique_ptr<BaseStep> strang_exact(const System& system, const PhiEvaluator& phi);

}  // namespace seiche
