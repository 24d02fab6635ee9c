// The functions of formulas as computer algebra knows them. Hold an AlgebraLock.
#pragma once

#include <seiche/formula/formula_expression.hpp>

#include <string>
#include <string_view>

namespace seiche {

// f(x) for a function of one variable that has a derivative. Throws Error for the others.
Expression call_function(std::string_view name, const Expression& x);

// As formulas call it.
std::string name_of_function(const Expression& function);

// c/cosh(x)ⁿ as c·sech(x)ⁿ, everywhere in the expression: the derivative of the former is ∞/∞ beyond x = 710.
Expression with_sech(const Expression& expression);

}  // namespace seiche
