#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/formula/algebra_functions.hpp>
#include <seiche/formula/expansion.hpp>
#include <seiche/formula/expression_text.hpp>
#include <seiche/formula/formula_expression.hpp>
#include <seiche/formula/formula_parser.hpp>

#include <cln/malloc.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace seiche {
namespace {

using Kind = Instruction::Kind;

// 0.1 becomes 1/10: the shortest decimal that reads back as the same double. Exact arithmetic on such numbers cancels
// where the user's decimals do, so that 0.1*u^3*3 − 0.3*u^3 has no degree.
Expression exact_number(double value) {
  std::array<char, 32> buffer{};
  char* const end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::scientific).ptr;
  const std::string text(buffer.data(), end);
  const std::size_t e = text.find('e');
  std::string digits = text.substr(0, e);
  long exponent = std::stol(text.substr(e + 1));
  const std::size_t point = digits.find('.');
  if (point != std::string::npos) {
    exponent -= static_cast<long>(digits.size() - point - 1);
    digits.erase(point, 1);
  }
  return GiNaC::numeric(digits.c_str()) * GiNaC::pow(GiNaC::numeric(10), GiNaC::numeric(exponent));
}

Error not_real(const Expression& expression) {
  return Error("'{}' is not a real function that can be evaluated", shortened(text_of(expression)));
}

// Exact arithmetic takes powers of all numbers in the base: with exponents that have no end neither has it.
Expression power(const Expression& base, const Expression& exponent) {
  constexpr int most = 1000;
  const bool is_number = GiNaC::is_a<GiNaC::numeric>(exponent);
  if (is_number && !GiNaC::is_a<GiNaC::symbol>(base) && GiNaC::abs(exponent) > most)
    throw Error("the power ({})^{} is out of range; of anything but one name, exponents are at most {}",
                shortened(text_of(base)), shortened(text_of(exponent)), most);
  if (is_number && bits_of(base) * std::abs(GiNaC::ex_to<GiNaC::numeric>(exponent).to_double()) > most_bits)
    throw Error("the power ({})^{} is a number of too many digits", shortened(text_of(base)),
                shortened(text_of(exponent)));
  if (base.is_zero() && is_number && exponent.info(GiNaC::info_flags::negative))
    throw Error("0^({}) divides by zero", shortened(text_of(exponent)));
  if (base.is_zero() && !is_number) throw Error("0^({}) has no derivative", shortened(text_of(exponent)));
  if (exponent.is_zero()) return 1;     // 0⁰ too, as where formulas are evaluated
  return GiNaC::power(base, exponent);  // not pow, which loses memory where it throws
}

std::mutex& algebra_mutex() {
  static std::mutex mutex;
  return mutex;
}

// CLN may serve others than this library, on other threads: their numbers are not bounded, and the hook that stood
// there comes back.
thread_local bool numbers_are_bounded = false;
thread_local double work = 0;  // products of machine words, as many as a multiplication of each number takes
void* (*allocate)(std::size_t) = nullptr;

}  // namespace

AlgebraLock::AlgebraLock() : lock_(algebra_mutex()) {
  allocate = cln::malloc_hook;
  cln::malloc_hook = [](std::size_t size) {
    if (numbers_are_bounded && size > largest)
      throw Error("computer algebra meets exact numbers of more than {} digits", largest * 12 / 5);
    constexpr double most_work = 1e9;
    const double words = static_cast<double>(size) / sizeof(void*);
    if (numbers_are_bounded && (work += words * words) > most_work) {
      work = 0;  // for those who go on without this result
      throw Error("computer algebra takes too long over its exact numbers");
    }
    return allocate(size);
  };
  numbers_are_bounded = true;
  work = 0;
}

AlgebraLock::~AlgebraLock() {
  numbers_are_bounded = false;
  cln::malloc_hook = allocate;
}

Expression to_expression(std::span<const Instruction> program, const Symbols& symbols) {
  std::vector<Expression> stack;
  const auto pop = [&] {
    Expression top = stack.back();
    stack.pop_back();
    return top;
  };
  for (const Instruction& instruction : program) {
    switch (instruction.kind) {
      case Kind::number: stack.push_back(exact_number(instruction.number)); continue;
      case Kind::variable: stack.emplace_back(symbols.at(static_cast<std::size_t>(instruction.index))); continue;
      default: break;
    }
    if (instruction.kind == Kind::call && instruction.function->arity != 1)
      throw Error("{} has no derivative here", instruction.function->name);
    const Expression b = pop();
    switch (instruction.kind) {
      case Kind::negate: stack.push_back(-b); break;
      case Kind::whole_power: stack.push_back(power(b, instruction.index)); break;
      case Kind::call: stack.push_back(call_function(instruction.function->name, b)); break;
      case Kind::add: stack.push_back(pop() + b); break;
      case Kind::subtract: stack.push_back(pop() - b); break;
      case Kind::multiply: stack.push_back(pop() * b); break;
      case Kind::divide: stack.push_back(pop() / b); break;
      default: stack.push_back(power(pop(), b)); break;
    }
  }
  return with_sech(stack.back());
}

void append_program(const Expression& expression, const Symbols& symbols, FormulaProgram& program) {
  if (GiNaC::is_a<GiNaC::constant>(expression)) {  // π
    append_program(expression.evalf(), symbols, program);
    return;
  }
  if (GiNaC::is_a<GiNaC::numeric>(expression)) {
    const auto& number = GiNaC::ex_to<GiNaC::numeric>(expression);
    if (!number.is_real()) throw not_real(expression);
    program.push_back({.kind = Kind::number, .number = number.to_double()});
    return;
  }
  if (GiNaC::is_a<GiNaC::symbol>(expression)) {
    const auto found = std::find_if(symbols.begin(), symbols.end(),
                                    [&](const Expression& symbol) { return symbol.is_equal(expression); });
    program.push_back({.kind = Kind::variable, .index = static_cast<int>(found - symbols.begin())});
    return;
  }
  if (GiNaC::is_a<GiNaC::add>(expression) || GiNaC::is_a<GiNaC::mul>(expression)) {
    const Kind kind = GiNaC::is_a<GiNaC::add>(expression) ? Kind::add : Kind::multiply;
    bool is_first = true;
    for (const Expression& operand : in_one_order(expression)) {
      append_program(operand, symbols, program);
      if (!is_first) program.push_back({.kind = kind});
      is_first = false;
    }
    return;
  }
  if (GiNaC::is_a<GiNaC::power>(expression)) {
    append_program(expression.op(0), symbols, program);
    const Expression exponent = expression.op(1);
    if (exponent.info(GiNaC::info_flags::integer) && GiNaC::abs(exponent) <= 1000000) {
      program.push_back({.kind = Kind::whole_power, .index = GiNaC::ex_to<GiNaC::numeric>(exponent).to_int()});
    } else if (exponent.is_equal(GiNaC::numeric(1, 2))) {
      program.push_back({.kind = Kind::call, .function = find_formula_function("sqrt")});
    } else {
      append_program(exponent, symbols, program);
      program.push_back({.kind = Kind::power});
    }
    return;
  }
  if (GiNaC::is_a<GiNaC::function>(expression)) {
    const FormulaFunction* function = find_formula_function(name_of_function(expression));
    if (function != nullptr && expression.nops() == 1) {
      append_program(expression.op(0), symbols, program);
      program.push_back({.kind = Kind::call, .function = function});
      return;
    }
  }
  throw not_real(expression);
}

Symbols make_symbols(const std::vector<std::string>& variables) {
  Symbols symbols;
  for (const std::string& name : variables) symbols.emplace_back(name);
  return symbols;
}

std::optional<double> real_number(const Expression& expression) {
  const Expression number = GiNaC::is_a<GiNaC::numeric>(expression) ? expression : expression.evalf();
  if (!GiNaC::is_a<GiNaC::numeric>(number)) return std::nullopt;
  const auto& x = GiNaC::ex_to<GiNaC::numeric>(number);
  return x.is_real() ? std::optional(x.to_double()) : std::nullopt;
}

}  // namespace seiche
