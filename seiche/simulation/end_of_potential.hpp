// Where V ends: of a step that failed, whether the solution was about to leave the values for which V is defined.
#pragma once

#include <seiche/core/state.hpp>
#include <seiche/core/system.hpp>

#include <string>

namespace seiche {

// "V is not a finite number at q = -1.0003, straight ahead of t = 0.5625 at t ≈ 0.61": the first place on the line
// z + s ż, 0 ≤ s ≤ 2h, at which V or a component of ∇V is NaN or infinite though the values of the state are moderate,
// with the field, the point, and the other values that V depends on there. h = 0: on the line up to a tenth of |z|.
// Where the state itself is such a place, "… at q = -1.0113 at t = 0.588". If the whole line is defined, that the
// largest of the values that V depends on is a million times as large as in `initial`, the physical values at the start
// of the run (not all zero), and that they move by more than a tenth of themselves in 2h: a blow-up; else "".
std::string end_of_potential(const Problem& problem, const System& system, const Vector& initial, const State& s,
                             double h);

}  // namespace seiche
