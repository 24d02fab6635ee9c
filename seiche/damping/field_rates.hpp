// Damping coefficients γ(x, t): a formula in the coordinates and t.
#pragma once

#include <seiche/core/damping_rate.hpp>
#include <seiche/formula/formula.hpp>

namespace seiche {

// A formula of the variables t, x, y, z, of which it may use t and the first `axes` coordinates (1 to 3), and t only if
// it is not `constant_in_time`. Where it has a pole its values are not finite; the caller checks.
SpaceRatePointer formula_space_rate(FormulaPointer formula, Index axes, bool constant_in_time);

// γ(t) at every point.
SpaceRatePointer uniform_space_rate(RatePointer rate);

}  // namespace seiche
