// What may be multiplied out, and what stays as it was written. Hold an AlgebraLock.
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

// True where an exponent is not a number, or one so large or so fine that powers of numbers, or common factors, take
// minutes.
bool has_endless_power(const Expression& expression);

// Where these symbols are 0, multiplied out if that takes milliseconds; else the expression itself, or as it is there.
Expression at_origin(const Expression& expression, const GiNaC::exmap& origin);

// True for a polynomial in `symbols` that can be multiplied out, with all symbols `beside` them, in some
// milliseconds.
bool is_small_polynomial(const Expression& expression, const GiNaC::lst& symbols, const Symbols& beside);
// True if a polynomial in `symbols` holds a third or higher power about a point that is not the origin, as (q − 10)⁴.
// Multiplied out, its terms are far larger than their sum, and its quadratic term does not show how stiff it is.
bool has_shifted_power(const Expression& expression, const GiNaC::lst& symbols);

}  // namespace seiche
