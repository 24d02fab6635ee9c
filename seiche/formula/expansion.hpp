// What may be multiplied out, and what stays as it was written. Hold algebra_mutex().
#pragma once

#include <seiche/formula/formula_expression.hpp>

namespace seiche {

// Of the numerator and denominator of a number, or of the one that a product begins with; 0 without one.
double bits_of(const Expression& base);
inline constexpr double most_bits = 20'000;  // of a number whose powers still take milliseconds

// So many terms stand at most above or below the line when all powers are multiplied out over a common denominator, in
// the expression or in what one of its functions is of.
double most_terms_multiplied_out(const Expression& expression);
inline constexpr double most_terms = 2000;  // that are multiplied out in milliseconds

// Is it a polynomial in `symbols` that can be multiplied out, with all symbols `beside` them, in a time that nobody
// notices?
bool is_small_polynomial(const Expression& expression, const GiNaC::lst& symbols, const Symbols& beside);
// Does a polynomial in `symbols` hold a third or higher power about a point that is not the origin, as (q − 10)⁴ is?
// Multiplied out, its terms are far larger than their sum, and its square is no stiffness that anybody feels.
bool has_shifted_power(const Expression& expression, const GiNaC::lst& symbols);

}  // namespace seiche
