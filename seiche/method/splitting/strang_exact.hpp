// Strang splitting between the damped linear flow and the rest.
#pragma once

#include <seiche/core/system.hpp>
#include <seiche/method/common/energy_law.hpp>
#include <seiche/method/projection/base_step.hpp>

#include <memory>

namespace seiche {

// Order two, with L = SM − D₀ and N(z) = S∇V(z) − (D − D₀)z, D taken at the middle of the step. Where S∇V moves momenta
// alone and D is D₀ the flow of N is a kick, and a step kick, e^{hL}, kick: one gradient, that of the end, which also
// tells V there. Elsewhere e^{hL/2}, ż = N(z) for h, e^{hL/2}: by the classical Runge–Kutta scheme of order four where
// D is D₀, and by the explicit midpoint rule else. `system` and `phi` outlive it.
std::unique_ptr<BaseStep> strang_exact(const System& system, const PhiEvaluator& phi, EnergyLaw law);

}  // namespace seiche
