// Exponential Gauss collocation with energy-interval projection: order 2s in s stages, and the law of H at every step.
#pragma once

#include <seiche/core/stepper.hpp>
#include <seiche/core/system.hpp>
#include <seiche/method/common/energy_law.hpp>

#include <memory>

namespace seiche {

// With L = SM − D₀ and N(t, z) = S∇V(z) − (D(t) − D₀)z, the collocation polynomial Σ a_k θᵏ through the forces
// F_i = N(Z_i) at the Gauss nodes c_i, and
//   z(θ) = φ₀(θhL)zⁿ + Σ_k h k! θ^{k+1} φ_{k+1}(θhL) a_k     (exact for ż = Lz + Σ a_k (t/h)ᵏ),
// a step extrapolates the forces of the last one, solves Z_i = z(c_i), F_i = N(Z_i) by sweeps
// (collocation_equations.hpp), and projects ẑ = z(1) to the energy of energy_target. Nothing about ẑ enters the law, so
// it holds for every h.
// `system` outlives the stepper.
std::unique_ptr<AdaptiveStepper> make_egc(const System& system, int stages, EnergyLaw law);

}  // namespace seiche
