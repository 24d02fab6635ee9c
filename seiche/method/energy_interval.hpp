// Which H a step is to end with: what the method computed, held inside the interval that the dissipation allows.
#pragma once

#include <seiche/method/energy_law.hpp>
#include <seiche/method/step_dissipation.hpp>

namespace seiche {

struct EnergyTarget {
  double H = 0.0;    // E*
  double cap = 0.0;  // no more than this is accepted
};

// With D and u = |D − D'| from two quadratures D, D' of ∫Q: E* = Ĥ, but not below Hⁿ − D − u, nor above Hⁿ − D + u, nor above
// Hⁿ. Without damping that is Hⁿ itself. Where the quadrature resolves the dissipation this is a two-sided law; where it
// does not, E* ≤ Hⁿ is what remains. If some Q < 0, exact solutions may gain energy, and Hⁿ is no bound.
// With the guard alone E* = min(Ĥ, Hⁿ), and of the dissipation only its sign is asked for.
//   before: Hⁿ,   computed: Ĥ of the method,   rest: H(0)
EnergyTarget energy_target(EnergyLaw law, double before, double computed, double rest,
                           const StepDissipation::Amount& dissipated, StepDissipation::Kind kind);

}  // namespace seiche
