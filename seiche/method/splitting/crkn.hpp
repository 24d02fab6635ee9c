// Conformal Runge–Kutta–Nyström splittings, for damped momenta.
#pragma once

#include <seiche/core/system.hpp>
#include <seiche/method/projection/base_step.hpp>

#include <memory>

namespace seiche {

// A: the damped linear flow e^{aL}, exact; B: the kick z += b S∇V(u). What the damping takes is known without
// quadrature: the sum over the A-flows of ½zᵀMz before less after, which is of the order of the splitting, since its
// equation joins the linear flow. Throws Error, with the reason, where ∇V moves more than momenta, where D varies in
// time or acts on more than momenta. `system` and `phi` outlive it.
std::unique_ptr<BaseStep> conformal_nystrom(const System& system, const PhiEvaluator& phi, int order);

// A: the drift u' = ∇T(v), v' = −γv, exact; B: the kick of v by all of ∇U(u), the linear part of it too. No
// exponential, so every h costs the same; stable for h below about 2 over the largest frequency. Throws Error where H =
// T(v) + U(u) or D = γ on momenta is not the form of the system.
std::unique_ptr<BaseStep> explicit_nystrom(const System& system, const PhiEvaluator& phi, int order);

}  // namespace seiche
