// A splitting of order four in which damping never runs backwards.
#pragma once

#include <seiche/core/system.hpp>
#include <seiche/method/projection/base_step.hpp>

#include <memory>

namespace seiche {

// With A the flow of ż = S∇H and B that of v̇ = −γv,
//   B(h/6) A(κh/2) B(2h/3) A(κh/2) B(h/6),   κ = 1/(1 + h²γ²/72).
// Of the positive splittings of order four by Suzuki and Chin this is the one for damping: they need the double
// commutator [B, [A, B]] beside A, and for H = T(v) + U(u) and T = ½vᵀM_v v it is −γ²A itself, so that it is absorbed
// into the length of A. A is a step of Krogstad's scheme with S M in the exponential, moved to the energy it started
// from; hence H never rises by the form of the step alone. Throws Error, with the reason, where the system has not this
// form. `system` and `phi` outlive it.
std::unique_ptr<BaseStep> chin_splitting(const System& system, const PhiEvaluator& phi);

}  // namespace seiche
