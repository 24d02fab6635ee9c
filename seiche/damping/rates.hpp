// Damping coefficients γ(t) and γ(x, t): a constant, or a formula in t and the coordinates.
#pragma once

#include <seiche/core/damping_rate.hpp>
#include <seiche/core/rate.hpp>
#include <seiche/formula/formula.hpp>

namespace seiche {

RatePointer constant_rate(double gamma);  // throws Error unless gamma is finite

// A formula of the one variable t; one that is constant becomes a constant_rate. Where it has a pole its values are not
// finite; the caller checks.
RatePointer formula_rate(FormulaPointer formula);

// ---- γ(x, t)

// A formula of the variables t, x, y, z, of which it may use t and the first `axes` coordinates (1 to 3), and t only if
// it is not `constant_in_time`. Where it has a pole its values are not finite; the caller checks.
SpaceRatePointer formula_space_rate(FormulaPointer formula, Index axes, bool constant_in_time);

// γ(t) at every point.
SpaceRatePointer uniform_space_rate(RatePointer rate);

}  // namespace seiche
