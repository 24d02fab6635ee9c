#include <seiche/config/custom/operator_formula.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/formula/expansion.hpp>
#include <seiche/formula/expression_text.hpp>
#include <seiche/formula/formula_expression.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace seiche {
namespace {

constexpr std::array derivative_names = {"d_x", "d_y", "d_z"};
constexpr std::array wave_names = {"k_x", "k_y", "k_z"};  // and k, their length
constexpr std::array place_names = {"t", "x", "y", "z"};

class OperatorReader {
 public:
  OperatorReader(const std::string& key, const std::string& text, const Grid& grid, Index axes,
                 Discretisation discretisation)
      : key_(key), text_(text), grid_(grid), axes_(axes), discretisation_(discretisation) {}

  OperatorFormula read(const FormulaConstants& constants, bool may_vary, const NameAdvice& advice) {
    std::vector<std::string> names;
    for (Index a = 0; a < axes_; ++a) names.emplace_back(derivative_names[static_cast<std::size_t>(a)]);
    if (axes_ > 0) names.emplace_back("laplacian");
    operators_ = names.size();
    add_wave_names(names, constants);
    const std::size_t constant = names.size();  // so many do not vary
    if (may_vary) names.insert(names.end(), place_names.begin(), place_names.begin() + 1 + axes_);
    FormulaProgram program;
    try {
      program = parse_formula(text_, names, constants, advice).program;
    } catch (const Error& error) {
      throw Error("{}: {}", key_, error.what());
    }
    const bool names_operator = names_variable(program, [&](std::size_t variable) { return variable < constant; });
    const bool varies = names_variable(program, [&](std::size_t variable) { return variable >= constant; });
    if (varies && !names_operator) return {.stencil = {}, .rate = text_};  // no algebra is needed
    refuse_kinks(program, may_vary);
    const AlgebraLock lock;
    symbols_ = make_symbols(names);
    for (const GiNaC::realsymbol& symbol : symbols_) all_.append(symbol);
    try {
      sort(to_expression(program, symbols_), true);
      make_multiplier(even_, Parity::even);
      make_multiplier(odd_, Parity::odd);
    } catch (const Error& error) {
      const std::string_view said = error.what();
      throw said.starts_with(key_) ? error : Error("{} = \"{}\": {}", key_, shortened(text_), said);
    } catch (const std::exception& error) {  // poles, overflow: GiNaC's own types
      throw Error("{} = \"{}\": {}", key_, shortened(text_), shortened(error.what()));
    }
    if (!rate_.is_zero()) {
      // What is constant belongs to the rate: only together they may be known to be ≥ 0.
      result_.stencil += Stencil::identity(-result_.stencil.identity_part());
      result_.rate = text_of(rate_ + constant_);
    }
    return std::move(result_);
  }

 private:
  // min, max and sign are not known to the algebra that sorts the terms. In a rate of its own, and of numbers, they may
  // stand.
  void refuse_kinks(const FormulaProgram& program, bool may_vary) const {
    for (const Instruction& instruction : program)
      if (instruction.kind == Instruction::Kind::call && !instruction.function->differentiable)
        throw Error(
            "{} = \"{}\": {} does not stand beside derivatives or wave numbers: {}", key_, shortened(text_),
            instruction.function->name,
            may_vary ? "D takes coefficients of derivatives, or a rate in t and the place, as in \"max(0.1, sin(t))\""
                     : "S and M take coefficients of derivatives, and smooth functions of wave numbers");
  }

  // Term by term; what is a polynomial is multiplied out.
  void sort(const Expression& expression, bool may_expand) {
    if (GiNaC::is_a<GiNaC::add>(expression)) {
      for (const Expression& term : in_one_order(expression)) sort(term, may_expand);
    } else if (may_expand && is_small_polynomial(expression, all_, symbols_)) {
      sort(expression.expand(), false);
    } else {
      add(expression);
    }
  }

  void add(const Expression& term) {
    Expression rest = term;
    std::array<int, 4> powers{};  // of d_x, d_y, d_z, laplacian
    bool has_operator = false;
    for (std::size_t i = 0; i < operators_; ++i) {
      if (!term.has(symbols_[i])) continue;
      const bool is_power = term.is_polynomial(symbols_[i]) && term.degree(symbols_[i]) == term.ldegree(symbols_[i]);
      if (!is_power)
        throw refused(term,
                      "derivatives stand in products with constants, and with functions of the wave numbers k_x and k");
      has_operator = true;
      const bool is_laplacian = i + 1 == operators_;
      powers[is_laplacian ? 3 : i] = term.degree(symbols_[i]);
      rest = rest.coeff(symbols_[i], term.degree(symbols_[i]));
    }
    const std::optional<double> c = real_number(rest);
    if (has_wave_number(rest)) {
      add_multiplier(term, rest, powers);
    } else if (c) {
      if (!has_operator) constant_ += term;
      result_.stencil += *c * derivative(term, powers);
    } else if (GiNaC::is_a<GiNaC::numeric>(rest.evalf())) {
      throw refused(term, "its coefficient is not real");
    } else if (has_operator) {
      throw refused(term, "the coefficient of a derivative is a constant");
    } else {
      rate_ += term;
    }
  }

  // The names of wave numbers that no parameter has taken.
  void add_wave_names(std::vector<std::string>& names, const FormulaConstants& constants) {
    const auto add = [&](const char* name) {
      if (constants.contains(name)) return;
      wave_names_.emplace_back(name);
      names.emplace_back(name);
    };
    for (Index a = 0; a < axes_; ++a) add(wave_names[static_cast<std::size_t>(a)]);
    if (axes_ > 0) add("k");
  }

  bool has_wave_number(const Expression& expression) const {
    return std::any_of(symbols_.begin() + operators_, symbols_.begin() + operators_ + wave_names_.size(),
                       [&](const GiNaC::realsymbol& symbol) { return expression.has(symbol); });
  }

  // ∂_a is iκ_a and the laplacian −|κ|²: with n of the former, iⁿ times a real function of κ.
  void add_multiplier(const Expression& term, const Expression& function, const std::array<int, 4>& powers) {
    const auto first_varying = static_cast<std::ptrdiff_t>(operators_ + wave_names_.size());
    if (std::any_of(symbols_.begin() + first_varying, symbols_.end(),
                    [&](const GiNaC::realsymbol& symbol) { return function.has(symbol); }))
      throw refused(term, "a function of the wave number stands beside t or a place");
    if (discretisation_ != Discretisation::spectral)
      throw refused(term, "functions of the wave number need problem.discretisation = \"spectral\"");
    const int derivatives = powers[0] + powers[1] + powers[2];
    const double sign = (derivatives / 2 + powers[3]) % 2 == 0 ? 1 : -1;
    (derivatives % 2 == 0 ? even_ : odd_)
        .push_back({parse_formula(text_of(function), wave_names_).program, powers, sign});
  }

  struct MultiplierTerm {
    FormulaProgram function;
    std::array<int, 4> powers;  // of κ_x, κ_y, κ_z, and of |κ|²
    double sign;
  };

  // All terms of one parity together: of 1/k² − 1/(k tanh k) only the sum has a limit.
  void make_multiplier(const std::vector<MultiplierTerm>& terms, Parity parity) {
    if (terms.empty()) return;
    const auto f = [terms, names = wave_names_](const WaveVector& kappa) {
      const double squares = square(kappa[0]) + square(kappa[1]) + square(kappa[2]);
      std::array<double, 4> arguments{};
      for (std::size_t i = 0; i < names.size(); ++i)
        arguments[i] = names[i] == "k" ? std::sqrt(squares) : kappa[static_cast<std::size_t>(names[i].back() - 'x')];
      double sum = 0;
      for (const auto& [function, powers, sign] : terms) {
        double value = sign * run_program(function, std::span(arguments).first(names.size()));
        for (std::size_t a = 0; a < 3; ++a) value *= std::pow(kappa[a], powers[a]);
        sum += value * std::pow(squares, powers[3]);
      }
      return sum;
    };
    result_.stencil += Stencil::multiplier(grid_, f, parity);
  }

  Stencil derivative(const Expression& term, const std::array<int, 4>& powers) const {
    Index axis = -1;
    int order = 0, axes = 0;
    for (Index a = 0; a < 3; ++a) {
      const int power = powers[static_cast<std::size_t>(a)];
      if (power == 0) continue;
      axis = a;
      order = power;
      ++axes;
    }
    // On a line the laplacian is the second derivative, and may be multiplied.
    const int laplacians = powers[3];
    if (laplacians > 0 && axes_ == 1) {
      axis = 0;
      axes = 1;
      order += 2 * laplacians;
    } else if (laplacians > 0) {
      if (laplacians > 1 || axes > 0)
        throw refused(term, "on a grid of several axes the laplacian is multiplied by constants only");
      return Stencil::laplacian(grid_, discretisation_);
    }
    if (axes == 0) return Stencil::identity();
    if (axes > 1)
      throw refused(term,
                    "products of derivatives along different axes are not there; in wave numbers d_x*d_y is -k_x*k_y");
    switch (order) {
      case 1: return Stencil::derivative(grid_, axis, discretisation_);
      case 2: return Stencil::second_derivative(grid_, axis, discretisation_);
      case 3: return Stencil::third_derivative(grid_, axis, discretisation_);
      case 4: return Stencil::fourth_derivative(grid_, axis, discretisation_);
      default: throw refused(term, "derivatives are there up to the fourth; in wave numbers d_x^6 is -k_x^6");
    }
  }

  Error refused(const Expression& term, const char* reason) const {
    return Error("{} = \"{}\": the term {} is not possible: {}", key_, shortened(text_), shortened(text_of(term)),
                 reason);
  }

  const std::string& key_;
  const std::string& text_;
  const Grid& grid_;
  Index axes_;
  Discretisation discretisation_;
  Symbols symbols_;
  GiNaC::lst all_;  // the same
  // The symbols are derivatives, the laplacian the last of them, then wave numbers, then what varies.
  std::size_t operators_ = 0;
  std::vector<std::string> wave_names_;
  Expression rate_ = 0, constant_ = 0;
  std::vector<MultiplierTerm> even_, odd_;
  OperatorFormula result_;
};

}  // namespace

bool is_one_rate(const std::string& a, const std::string& b, const FormulaConstants& constants) {
  if (a == b) return true;
  const std::vector<std::string> names(place_names.begin(), place_names.end());
  const AlgebraLock lock;
  const Symbols symbols = make_symbols(names);
  GiNaC::lst all;
  for (const GiNaC::realsymbol& symbol : symbols) all.append(symbol);
  try {
    const Expression difference = to_expression(parse_formula(a, names, constants).program, symbols) -
                                  to_expression(parse_formula(b, names, constants).program, symbols);
    return difference.is_zero() || (is_small_polynomial(difference, all, symbols) && difference.expand().is_zero());
  } catch (const std::exception&) {  // min, max, poles: not known to the algebra
    return false;
  }
}

OperatorFormula compile_operator(const std::string& key, const std::string& text, const Grid& grid, Index axes,
                                 Discretisation discretisation, const FormulaConstants& constants, bool may_vary,
                                 const NameAdvice& advice) {
  return OperatorReader(key, text, grid, axes, discretisation).read(constants, may_vary, advice);
}

}  // namespace seiche
