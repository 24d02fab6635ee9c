// Which H a step is to end with: what the method computed, held inside the interval that the dissipation allows.
#pragma once

#include <seiche/core/function_ref.hpp>
#include <seiche/method/projection/energy_law.hpp>
#include <seiche/method/projection/step_dissipation.hpp>

#include <limits>

namespace seiche {

struct EnergyTarget {
  double H = 0.0;        // E*
  double cap = 0.0;      // no more than this is accepted
  bool widened = false;  // is E* farther from what the two quadratures alone would have given than they are apart?
  double terms = std::numeric_limits<double>::infinity();  // the sizes of the terms of Hⁿ, where they bound round-off
};

// With D and u = |D − D'| from two quadratures D, D' of ∫Q: E* = Ĥ, but not below Hⁿ − D − u, nor above Hⁿ − D + u, nor
// above Hⁿ. Without damping that is Hⁿ itself. If some Q < 0, exact solutions may gain energy, and Hⁿ is no bound.
// Where a layer or an oscillation is shorter than the step, both quadratures miss the same and agree. Hence u grows by
// 8 times what D misses of the linear flow, where Ĥ lies outside the interval: what the quadrature resolves is a
// two-sided law, and of the rest E* ≤ Hⁿ remains.
// With the guard alone E* = min(Ĥ, Hⁿ), and of the dissipation only its sign is asked for.
//   before: Hⁿ,   computed: Ĥ of the method,   rest: H(0),   flow_missed: asked for only where it can matter
EnergyTarget energy_target(EnergyLaw law, double before, double computed, double rest,
                           const StepDissipation::Amount& dissipated, StepDissipation::Kind kind,
                           FunctionRef<double()> flow_missed);

}  // namespace seiche
