// Expressions as a reader would write them, and in one order: computer algebra keeps its terms in another one every
// run.
#pragma once

#include <seiche/formula/formula_expression.hpp>

#include <string>
#include <vector>

namespace seiche {

// As a formula that reads the same, 0.5*p^2 - cos(q), and the operands of a sum or product in the order of their texts:
// the order of computer algebra changes from run to run, and with it the last bits of what is computed.
std::string text_of(const Expression& expression);
std::vector<Expression> in_one_order(const Expression& expression);

}  // namespace seiche
