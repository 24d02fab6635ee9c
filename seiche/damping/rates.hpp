// Damping coefficients γ(t): a constant, or a formula in t.
#pragma once

#include <seiche/core/rate.hpp>
#include <seiche/formula/formula.hpp>

namespace seiche {

RatePointer constant_rate(double gamma);  // throws Error unless gamma is finite

// A formula of the one variable t; one that is constant becomes a constant_rate. Where it has a pole its values are not
// finite; the caller checks.
RatePointer formula_rate(FormulaPointer formula);

}  // namespace seiche
