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

// Of an expression without symbols; nothing where there are some, or where it is not real.
std::optional<double> real_number(const Expression& expression);

}  // namespace seiche
