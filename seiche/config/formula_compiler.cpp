#include <seiche/config/formula_compiler.hpp>
#include <seiche/config/formula_parser.hpp>
#include <seiche/config/formula_program.hpp>
#include <seiche/core/error.hpp>

#include <ginac/ginac.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <mutex>
#include <sstream>
#include <utility>

namespace seiche {
namespace {

using Kind = Instruction::Kind;
using Expression = GiNaC::ex;
using Symbols = std::vector<GiNaC::realsymbol>;  // real, or the derivative of abs speaks of conjugates

// GiNaC counts references without atomics, also of objects that all expressions share.
std::mutex& algebra_mutex() {
  static std::mutex mutex;
  return mutex;
}

class CompiledFormula final : public Formula {
 public:
  CompiledFormula(std::string text, std::vector<std::string> variables, FormulaProgram program,
                  std::optional<std::vector<double>> polynomial)
      : text_(std::move(text)),
        variables_(std::move(variables)),
        program_(std::move(program)),
        polynomial_(std::move(polynomial)) {}

  double operator()(std::span<const double> arguments) const override { return run_program(program_, arguments); }
  const std::string& text() const override { return text_; }
  const std::optional<std::vector<double>>& polynomial() const override { return polynomial_; }

  const std::vector<std::string>& variables() const { return variables_; }
  const FormulaProgram& program() const { return program_; }

 private:
  std::string text_;
  std::vector<std::string> variables_;
  FormulaProgram program_;
  std::optional<std::vector<double>> polynomial_;
};

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

Expression to_expression(const FormulaProgram& program, const Symbols& symbols) {
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
      case Kind::whole_power: stack.push_back(GiNaC::pow(b, instruction.index)); break;
      case Kind::call: stack.push_back(call_function(instruction.function->name, b)); break;
      case Kind::add: stack.push_back(pop() + b); break;
      case Kind::subtract: stack.push_back(pop() - b); break;
      case Kind::multiply: stack.push_back(pop() * b); break;
      case Kind::divide: stack.push_back(pop() / b); break;
      default: stack.push_back(GiNaC::pow(pop(), b)); break;
    }
  }
  return stack.back();
}

Error not_real(const Expression& expression) {
  std::ostringstream text;
  text << expression;
  return Error("'{}' is not a real function that can be evaluated", text.str());
}

void append_program(const Expression& given, const Symbols& symbols, FormulaProgram& program) {
  const Expression expression = GiNaC::is_a<GiNaC::constant>(given) ? given.evalf() : given;  // π
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
    for (std::size_t i = 0; i < expression.nops(); ++i) {
      append_program(expression.op(i), symbols, program);
      if (i > 0) program.push_back({.kind = kind});
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

// c₀, c₁, … of a polynomial in one variable, or nothing where they do not fit a double.
std::optional<std::vector<double>> coefficients(const FormulaProgram& program,
                                                const std::vector<std::string>& variables) {
  const std::scoped_lock lock(algebra_mutex());
  const Symbols symbols = make_symbols(variables.empty() ? std::vector<std::string>{"x"} : variables);
  const Expression expanded = to_expression(program, symbols).expand();
  const int degree = expanded.degree(symbols[0]);
  std::vector<double> result;
  for (int k = 0; k <= degree; ++k) {
    const Expression coefficient = expanded.coeff(symbols[0], k);
    result.push_back(GiNaC::ex_to<GiNaC::numeric>(coefficient).to_double());
    if (!std::isfinite(result.back())) return std::nullopt;
  }
  return result;
}

FormulaPointer make_formula(std::string text, std::vector<std::string> variables, ParsedFormula parsed) {
  std::optional<std::vector<double>> polynomial;
  if (parsed.degree >= 0 && variables.size() <= 1) polynomial = coefficients(parsed.program, variables);
  return std::make_shared<CompiledFormula>(std::move(text), std::move(variables), std::move(parsed.program),
                                           std::move(polynomial));
}

FormulaProgram derivative_program(const CompiledFormula& formula, std::size_t variable) {
  const std::scoped_lock lock(algebra_mutex());
  const Symbols symbols = make_symbols(formula.variables());
  FormulaProgram program;
  try {
    append_program(to_expression(formula.program(), symbols).diff(symbols[variable]), symbols, program);
  } catch (const Error& error) {
    throw Error("the formula '{}' cannot be differentiated: {}", formula.text(), error.what());
  } catch (const std::exception& error) {  // poles, overflow: GiNaC's own types
    throw Error("the formula '{}' cannot be differentiated: {}", formula.text(), error.what());
  }
  if (stack_needed(program) > formula_stack_size)
    throw Error("the derivative of '{}' is too deeply nested", formula.text());
  return program;
}

}  // namespace

FormulaPointer compile_formula(const std::string& text, const std::vector<std::string>& variables) {
  return make_formula(text, variables, parse_formula(text, variables));
}

FormulaPointer differentiate(const Formula& formula, const std::string& variable) {
  const auto* compiled = dynamic_cast<const CompiledFormula*>(&formula);
  if (compiled == nullptr) throw Error("only a formula that was compiled from text can be differentiated");
  const std::vector<std::string>& variables = compiled->variables();
  const auto found = std::find(variables.begin(), variables.end(), variable);
  if (found == variables.end()) throw unknown_name("variable", variable, variables);

  ParsedFormula derivative;
  derivative.program = derivative_program(*compiled, static_cast<std::size_t>(found - variables.begin()));
  // A polynomial stays one; where f is none, its derivative is not asked.
  const auto& c = compiled->polynomial();
  std::optional<std::vector<double>> polynomial;
  if (c) {
    polynomial.emplace();
    for (std::size_t k = 1; k < c->size(); ++k) polynomial->push_back(static_cast<double>(k) * (*c)[k]);
    if (polynomial->empty()) polynomial->push_back(0.0);
  }
  return std::make_shared<CompiledFormula>(fmt::format("d/d{} ({})", variable, formula.text()), variables,
                                           std::move(derivative.program), std::move(polynomial));
}

}  // namespace seiche
