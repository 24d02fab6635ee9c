#include <seiche/formula/formula_program.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace seiche {
namespace {

using Kind = Instruction::Kind;

double whole_power(double x, int exponent) {
  switch (exponent) {  // the frequent ones without a call
    case -2: return 1.0 / (x * x);
    case -1: return 1.0 / x;
    case 2: return x * x;
    case 3: return x * x * x;
    default: return std::pow(x, exponent);
  }
}

}  // namespace

int operands(const Instruction& instruction) {
  switch (instruction.kind) {
    case Kind::number:
    case Kind::variable: return 0;
    case Kind::negate:
    case Kind::whole_power: return 1;
    case Kind::call: return instruction.function->arity;
    default: return 2;
  }
}

int stack_needed(std::span<const Instruction> program) {
  int depth = 0;
  int deepest = 0;
  for (const Instruction& instruction : program) {
    depth += 1 - operands(instruction);
    deepest = std::max(deepest, depth);
  }
  return deepest;
}

double run_program(std::span<const Instruction> program, std::span<const double> arguments) {
  // Written before it is read, and zeroing costs more than a sine.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
  std::array<double, formula_stack_size + 1> stack;
  double* top = stack.data();  // the entry below the first is never read
  for (const Instruction& instruction : program) {
    switch (instruction.kind) {
      case Kind::number: *++top = instruction.number; break;
      case Kind::variable: {
        const auto index = static_cast<std::size_t>(instruction.index);
        *++top = index < arguments.size() ? arguments[index] : std::numeric_limits<double>::quiet_NaN();
        break;
      }
      case Kind::add: --top, *top += top[1]; break;
      case Kind::subtract: --top, *top -= top[1]; break;
      case Kind::multiply: --top, *top *= top[1]; break;
      case Kind::divide: --top, *top /= top[1]; break;
      case Kind::negate: *top = -*top; break;
      case Kind::power: --top, *top = std::pow(*top, top[1]); break;
      case Kind::whole_power: *top = whole_power(*top, instruction.index); break;
      case Kind::call:
        if (instruction.function->arity == 1) {
          *top = instruction.function->one(*top);
        } else {
          --top, *top = instruction.function->two(*top, top[1]);
        }
        break;
    }
  }
  return *top;
}

}  // namespace seiche
