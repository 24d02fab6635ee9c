// Langevin's equation by any method: its step without damping, between two halves of the flow of a bath.
#pragma once

#include <seiche/core/stepper.hpp>
#include <seiche/noise/bath.hpp>

#include <memory>

namespace seiche {

// z ← O(t+h/2, t+h) Φ_h O(t, t+h/2) z, with O the flow of the bath and Φ the step of `inner`: of weak order two. Φ
// starts anew in every step, since noise has moved what it remembers. H may rise; there is no modified energy.
std::unique_ptr<Stepper> with_noise(std::unique_ptr<Bath> bath, std::unique_ptr<Stepper> inner);

}  // namespace seiche
