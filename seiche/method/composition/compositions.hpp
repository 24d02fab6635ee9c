// Where the damping goes: merged into S (whole), or split off and halved around the Hamiltonian substep (strang).
#pragma once

#include <seiche/core/stepper.hpp>
#include <seiche/method/closure/closure.hpp>

#include <memory>

namespace seiche {

// z ← Φ_h z, for a system without damping flow: S' = S − D, or no damping at all.
std::unique_ptr<Stepper> make_whole(const System& system, PropagatorKind propagator, std::unique_ptr<Closure> closure);

// z ← Ψ(t+h/2, t+h) Φ_h Ψ(t, t+h/2) z, with exact Ψ = exp(−∫D); external forces give z the impulse ∫f before and after.
std::unique_ptr<Stepper> make_strang(const System& system, PropagatorKind propagator, std::unique_ptr<Closure> closure);

}  // namespace seiche
