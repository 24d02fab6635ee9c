// Between programs and the expressions of computer algebra. Hold an AlgebraLock as long as an expression lives.
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

// One thread at a time: GiNaC counts references without atomics, also of objects that all expressions share. While it
// is held, exact numbers of more than `largest` bytes throw Error, wherever algebra makes them, and so does work on
// long ones that would take longer than some seconds.
class AlgebraLock {
 public:
  static constexpr std::size_t largest = std::size_t{1} << 15U;

  AlgebraLock();
  ~AlgebraLock();
  AlgebraLock(const AlgebraLock&) = delete;
  AlgebraLock& operator=(const AlgebraLock&) = delete;

 private:
  std::scoped_lock<std::mutex> lock_;
};

Symbols make_symbols(const std::vector<std::string>& variables);

// Numbers become the exact decimals that they were written as. Throws Error for functions without a derivative.
Expression to_expression(std::span<const Instruction> program, const Symbols& symbols);

// Appends the instructions that leave its value on the stack. Throws Error where that is not a real function.
void append_program(const Expression& expression, const Symbols& symbols, FormulaProgram& program);

// Of an expression without symbols; nothing where there are some, or where it is not real.
std::optional<double> real_number(const Expression& expression);

}  // namespace seiche
