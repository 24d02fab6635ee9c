// Between programs and the expressions of computer algebra. Hold algebra_mutex() as long as an expression lives.
#pragma once

#include <seiche/formula/formula_program.hpp>

#include <ginac/ginac.h>

#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace seiche {

using Expression = GiNaC::ex;
using Symbols = std::vector<GiNaC::realsymbol>;  // real, or the derivative of abs speaks of conjugates

std::mutex& algebra_mutex();
Symbols make_symbols(const std::vector<std::string>& variables);

// Numbers become the exact decimals that they were written as. Throws Error for functions without a derivative.
Expression to_expression(std::span<const Instruction> program, const Symbols& symbols);

// Appends the instructions that leave its value on the stack. Throws Error where that is not a real function.
void append_program(const Expression& expression, const Symbols& symbols, FormulaProgram& program);

// As a formula that reads the same, 0.5*p^2 - cos(q), and the operands of a sum or product in the order of their texts:
// the order of computer algebra changes from run to run, and with it the last bits of what is computed.
std::string text_of(const Expression& expression);
std::vector<Expression> in_one_order(const Expression& expression);

// Of an expression without symbols; nothing where there are some, or where it is not real.
std::optional<double> real_number(const Expression& expression);

// u·∇W(u) ≥ 0 for every u in `fields`, whatever the other symbols are, as far as the form of W shows: sums and products
// of even powers, rising functions of what grows outward (√(1 + p²), cosh q, 1 − sech q), what is convex and at rest at
// 0 (eᵘ − u − 1), and forms ½uᵀAu with bounded coefficients in the other symbols that keep A ⪰ 0. False says that the
// form does not show it. Hold algebra_mutex().
bool grows_outward(const Expression& w, const Symbols& fields);

}  // namespace seiche
