// Which H a step is to end with: what the method computed, held inside the interval that the dissipation allows.
#pragma once

#include <seiche/core/base/function_ref.hpp>
#include <seiche/method/common/energy_law.hpp>
#include <seiche/method/projection/step_dissipation.hpp>

#include <limits>

namespace seiche {

struct EnergyTarget {
  double H = 0.0;        // E*
  double cap = 0.0;      // no more than this is accepted
  bool strong = false;   // damping acts so strongly in the step that only the guard is left
  bool widened = false;  // E* shows that the quadratures missed some of the dissipation
  double terms = std::numeric_limits<double>::infinity();  // the sizes of the terms of Hⁿ, where they bound round-off
};

// With D and u = |D − D'| from two quadratures D, D' of ∫Q: E* = Ĥ, but not below Hⁿ − D − u, nor above Hⁿ − D + u, nor
// above Hⁿ. Without damping that is Hⁿ itself. If some Q < 0, exact solutions may gain energy, and Hⁿ is no bound.
// Where a layer or an oscillation is shorter than the step, in the linear flow, in V or by friction, both quadratures
// miss the same and agree. Hence u grows where Ĥ lies outside the interval: by 8 times what D misses of the linear
// flow, and by D x/(1 − x), with x = min(1, (hρ/0.07)⁶) for the largest rate ρ at which damping acts in the step
// (DampingStrength). What the quadrature resolves is a two-sided law, and of the rest E* ≤ Hⁿ remains.
// With the guard alone E* = min(Ĥ, Hⁿ), and of the dissipation only its sign is asked for.
//   before: Hⁿ,   computed: Ĥ of the method,   rest: H(0)
//   damped: hρ, and flow_missed: each asked for only where it can matter
EnergyTarget energy_target(EnergyLaw law, double before, double computed, double rest,
                           const StepDissipation::Amount& dissipated, StepDissipation::Kind kind,
                           FunctionRef<double()> damped, FunctionRef<double()> flow_missed);

}  // namespace seiche
