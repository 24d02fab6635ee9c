#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/formula/formula_compiler.hpp>
#include <seiche/formula/formula_expression.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace seiche {
namespace {

class CompiledFormula final : public Formula {
 public:
  CompiledFormula(std::string text, std::vector<std::string> variables, FormulaProgram program,
                  std::optional<std::vector<double>> polynomial)
      : text_(std::move(text)),
        variables_(std::move(variables)),
        program_(std::move(program)),
        polynomial_(std::move(polynomial)) {}

  double operator()(std::span<const double> arguments) const override { return run_program(program_, arguments); }
  std::span<const Instruction> program() const override { return program_; }
  const std::string& text() const override { return text_; }
  const std::optional<std::vector<double>>& polynomial() const override { return polynomial_; }

  const std::vector<std::string>& variables() const { return variables_; }

 private:
  std::string text_;
  std::vector<std::string> variables_;
  FormulaProgram program_;
  std::optional<std::vector<double>> polynomial_;
};

// c₀, c₁, … of a polynomial in one variable, or nothing where they do not fit a double.
std::optional<std::vector<double>> coefficients(std::span<const Instruction> program,
                                                const std::vector<std::string>& variables) {
  const AlgebraLock lock;
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
  const AlgebraLock lock;
  const Symbols symbols = make_symbols(formula.variables());
  FormulaProgram program;
  try {
    append_program(to_expression(formula.program(), symbols).diff(symbols[variable]), symbols, program);
  } catch (const Error& error) {
    throw Error("the formula '{}' cannot be differentiated: {}", shortened(formula.text()),
                shortened(error.what(), 200));
  } catch (const std::exception& error) {  // poles, overflow: GiNaC's own types
    throw Error("the formula '{}' cannot be differentiated: {}", shortened(formula.text()),
                shortened(error.what(), 200));
  }
  if (stack_needed(program) > formula_stack_size)
    throw Error("the derivative of '{}' is too deeply nested", shortened(formula.text()));
  return program;
}

}  // namespace

FormulaPointer compile_formula(const std::string& text, const std::vector<std::string>& variables,
                               const FormulaConstants& constants, const NameAdvice& advice) {
  return make_formula(text, variables, parse_formula(text, variables, constants, advice));
}

FormulaPointer formula_of(std::string text, const std::vector<std::string>& variables, FormulaProgram program) {
  return std::make_shared<CompiledFormula>(std::move(text), variables, std::move(program), std::nullopt);
}

FormulaPointer differentiate(const Formula& formula, const std::string& variable) {
  const auto* compiled = dynamic_cast<const CompiledFormula*>(&formula);
  if (compiled == nullptr) throw Error("only a formula that was compiled from text can be differentiated");
  const std::vector<std::string>& variables = compiled->variables();
  const auto found = std::find(variables.begin(), variables.end(), variable);
  if (found == variables.end()) throw unknown_name("variable", variable, variables);

  ParsedFormula derivative;
  derivative.program = derivative_program(*compiled, static_cast<std::size_t>(found - variables.begin()));
  // The derivative of a polynomial is one; that of another f is not examined.
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
