// A formula as instructions for a stack machine: evaluated in double, without allocation, from any number of threads.
// Computer algebra objects have none of these properties: a compiled formula holds none.
#pragma once

#include <seiche/formula/formula_function.hpp>

#include <span>
#include <vector>

namespace seiche {

struct Instruction {
  enum class Kind { number, variable, add, subtract, multiply, divide, negate, power, whole_power, call };
  Kind kind = Kind::number;
  double number = 0.0;  // of `number`
  int index = 0;        // of `variable`: which one; of `whole_power`: the exponent
  const FormulaFunction* function = nullptr;
};

using FormulaProgram = std::vector<Instruction>;

inline constexpr int formula_stack_size = 256;

// True if it names a variable of which `is_asked(index)` holds.
template <class IsAsked>
bool names_variable(std::span<const Instruction> program, const IsAsked& is_asked) {
  for (const Instruction& i : program)
    if (i.kind == Instruction::Kind::variable && is_asked(static_cast<std::size_t>(i.index))) return true;
  return false;
}

int operands(const Instruction& instruction);  // how many: 0, 1 or 2
int stack_needed(std::span<const Instruction> program);

// The program must need at most formula_stack_size. Never throws; what is not real comes back as NaN.
double run_program(std::span<const Instruction> program, std::span<const double> arguments);

}  // namespace seiche
