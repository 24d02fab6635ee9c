#include <seiche/config/formula_expression.hpp>
#include <seiche/config/formula_parser.hpp>
#include <seiche/core/error.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
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

Expression call_function(std::string_view name, const Expression& x) {
  using Apply = Expression (*)(const Expression&);
  static const std::map<std::string_view, Apply> functions = {
      {"sin", [](const Expression& a) -> Expression { return GiNaC::sin(a); }},
      {"cos", [](const Expression& a) -> Expression { return GiNaC::cos(a); }},
      {"tan", [](const Expression& a) -> Expression { return GiNaC::tan(a); }},
      {"asin", [](const Expression& a) -> Expression { return GiNaC::asin(a); }},
      {"acos", [](const Expression& a) -> Expression { return GiNaC::acos(a); }},
      {"atan", [](const Expression& a) -> Expression { return GiNaC::atan(a); }},
      {"sinh", [](const Expression& a) -> Expression { return GiNaC::sinh(a); }},
      {"cosh", [](const Expression& a) -> Expression { return GiNaC::cosh(a); }},
      {"tanh", [](const Expression& a) -> Expression { return GiNaC::tanh(a); }},
      {"asinh", [](const Expression& a) -> Expression { return GiNaC::asinh(a); }},
      {"acosh", [](const Expression& a) -> Expression { return GiNaC::acosh(a); }},
      {"atanh", [](const Expression& a) -> Expression { return GiNaC::atanh(a); }},
      {"exp", [](const Expression& a) -> Expression { return GiNaC::exp(a); }},
      {"log", [](const Expression& a) -> Expression { return GiNaC::log(a); }},
      {"sqrt", [](const Expression& a) -> Expression { return GiNaC::sqrt(a); }},
      {"abs", [](const Expression& a) -> Expression { return GiNaC::abs(a); }},
      {"sech", [](const Expression& a) -> Expression { return 1 / GiNaC::cosh(a); }},
  };
  const auto found = functions.find(name);
  if (found == functions.end()) throw Error("{} has no derivative here", name);
  return found->second(x);
}

Error not_real(const Expression& expression) {
  return Error("'{}' is not a real function that can be evaluated", text_of(expression));
}

constexpr double most_bits = 20'000;  // of a number whose powers still take milliseconds

double bits_of_number(const Expression& number) {
  if (!GiNaC::is_a<GiNaC::numeric>(number) || !number.info(GiNaC::info_flags::rational)) return 0;
  const auto& x = GiNaC::ex_to<GiNaC::numeric>(number);
  return x.numer().int_length() + x.denom().int_length();
}

// Of a number, or of the one that a product begins with.
double bits_of(const Expression& base) {
  double bits = bits_of_number(base);
  for (std::size_t i = 0; GiNaC::is_a<GiNaC::mul>(base) && i < base.nops(); ++i) bits += bits_of_number(base.op(i));
  return bits;
}

// Exact arithmetic takes powers of all numbers in the base: with exponents that have no end neither has it.
Expression power(const Expression& base, const Expression& exponent) {
  constexpr int most = 1000;
  const bool is_number = GiNaC::is_a<GiNaC::numeric>(exponent);
  if (is_number && !GiNaC::is_a<GiNaC::symbol>(base) && GiNaC::abs(exponent) > most)
    throw Error("the power ({})^{} is out of range; of anything but one name, exponents are at most {}", text_of(base),
                text_of(exponent), most);
  if (is_number && bits_of(base) * std::abs(GiNaC::ex_to<GiNaC::numeric>(exponent).to_double()) > most_bits)
    throw Error("the power ({})^{} is a number of too many digits", text_of(base), text_of(exponent));
  if (base.is_zero() && is_number && exponent.info(GiNaC::info_flags::negative))
    throw Error("0^({}) divides by zero", text_of(exponent));
  if (base.is_zero() && !is_number) throw Error("0^({}) has no derivative", text_of(exponent));
  if (exponent.is_zero()) return 1;     // 0⁰ too, as where formulas are evaluated
  return GiNaC::power(base, exponent);  // not pow, which loses memory where it throws
}

}  // namespace

// GiNaC counts references without atomics, also of objects that all expressions share.
std::mutex& algebra_mutex() {
  static std::mutex mutex;
  return mutex;
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
  return stack.back();
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
    const FormulaFunction* function = find_formula_function(GiNaC::ex_to<GiNaC::function>(expression).get_name());
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

namespace {

// At most so many terms stand in it when it is multiplied out: C(n + m − 1, n) in the n-th power of m terms.
double terms_multiplied_out(const Expression& expression) {
  double terms = 1;
  if (GiNaC::is_a<GiNaC::add>(expression)) {
    terms = 0;
    for (const Expression& term : expression) terms += terms_multiplied_out(term);
  } else if (GiNaC::is_a<GiNaC::mul>(expression)) {
    for (const Expression& factor : expression) terms *= terms_multiplied_out(factor);
  } else if (GiNaC::is_a<GiNaC::power>(expression) && expression.op(1).info(GiNaC::info_flags::posint)) {
    const double m = terms_multiplied_out(expression.op(0));
    const double n = GiNaC::ex_to<GiNaC::numeric>(expression.op(1)).to_double();
    for (double k = 1; k <= n && m > 1; ++k) terms *= (m - 1 + k) / k;
  }
  return terms;
}

}  // namespace

bool is_small_polynomial(const Expression& expression, const GiNaC::lst& symbols, const Symbols& beside) {
  if (!expression.is_polynomial(symbols)) return false;
  constexpr double most_terms = 2000;
  double terms = 1;
  double degree = 0, bits = 0;
  int used = 0;
  for (auto part = expression.preorder_begin(); part != expression.preorder_end(); ++part)
    bits = std::max(bits, bits_of_number(*part));
  for (const GiNaC::realsymbol& symbol : beside) {
    if (!expression.has(symbol)) continue;
    if (!expression.is_polynomial(symbol)) {  // beside the polynomial, as 1/x is: no degree bounds its powers
      if (terms_multiplied_out(expression) > most_terms) return false;
      continue;
    }
    degree += expression.degree(symbol);
    ++used;
  }
  for (int k = 1; k <= used; ++k) terms *= (degree + k) / k;
  return degree <= highest_degree * std::max(used, 1) && terms <= most_terms && degree * bits <= most_bits;
}

bool has_shifted_power(const Expression& expression, const GiNaC::lst& symbols) {
  GiNaC::exmap origin;
  for (const Expression& symbol : symbols) origin[symbol] = 0;
  const auto is_shifted = [&](const Expression& base) {
    if (!GiNaC::is_a<GiNaC::add>(base) || base.subs(origin).expand().is_zero()) return false;
    return std::any_of(symbols.begin(), symbols.end(), [&](const Expression& symbol) {
      return !base.diff(GiNaC::ex_to<GiNaC::symbol>(symbol)).subs(origin).expand().is_zero();
    });
  };
  for (auto part = expression.preorder_begin(); part != expression.preorder_end(); ++part)
    if (GiNaC::is_a<GiNaC::power>(*part) && part->op(1).info(GiNaC::info_flags::posint) && part->op(1) > 2 &&
        is_shifted(part->op(0)))
      return true;
  return false;
}

}  // namespace seiche
