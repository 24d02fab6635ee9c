// Errors of one-step methods, for variable steps.
#pragma once

#include <seiche/core/stepper.hpp>
#include <seiche/core/system.hpp>
#include <seiche/method/projection/projected.hpp>

#include <memory>

namespace seiche {

// The step of `stepper` beside the exponential Runge–Kutta scheme of order three on the same N (Cox & Matthews 2002),
//   z_e = φ₀zⁿ + h[(φ₁ − 3φ₂ + 4φ₃)N(zⁿ) + (4φ₂ − 8φ₃)N(ẑ) + (4φ₃ − φ₂)N(zⁿ⁺¹)],
// φ_k of hL with the whole linear part, ẑ the exponential midpoint: the difference contains the error of the splitting.
// Two gradients a step. Between steps, a shorter step of the same method from the left end. `system` outlives the
// stepper.
std::unique_ptr<AdaptiveStepper> with_error_estimate(const System& system, std::unique_ptr<Stepper> stepper);

// Step doubling (Richardson), for a method of order p without an estimate of its own: error ≈ ‖z_h − z_{h/2}‖/(2ᵖ − 1);
// the two half steps are kept. Between steps, a shorter step of the same method from the left end of either half.
std::unique_ptr<AdaptiveStepper> with_step_doubling(const System& system, std::unique_ptr<ProjectedStepper> stepper,
                                                    int order);
std::unique_ptr<AdaptiveStepper> with_step_doubling(const System& system, std::unique_ptr<Stepper> stepper, int order);

}  // namespace seiche
