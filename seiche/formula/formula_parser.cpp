#include <seiche/core/base/shortened.hpp>
#include <seiche/formula/formula_parser.hpp>
#include <seiche/formula/formula_text.hpp>
#include <seiche/formula/other_languages.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace seiche {
namespace {

using Kind = Instruction::Kind;

constexpr int not_polynomial = -1;

// A part of the formula already read: its instructions are the program from `begin` on.
struct Part {
  std::size_t begin;
  std::size_t position;  // in the text
  int degree;
  bool constant;
};

class Parser {
 public:
  Parser(std::string_view text, const std::vector<std::string>& variables, const FormulaConstants& constants,
         const NameAdvice& advice, FunctionsAllowed allowed)
      : text_(text),
        variables_(variables),
        constants_(constants),
        advice_(advice),
        allowed_(allowed),
        tokens_(tokenise_formula(text, variables)) {}

  ParsedFormula parse() {
    if (token().kind == FormulaToken::Kind::end) throw formula_error(text_, 0, "the formula is empty");
    const Part whole = sum();
    if (token().is(')')) throw error("this parenthesis closes nothing");
    if (token().is(',')) throw error("a comma stands between arguments only; decimals are written with a point: 0.5");
    if (stack_needed(program_) > formula_stack_size) throw formula_error(text_, 0, "the formula is too deeply nested");
    return {.program = std::move(program_), .degree = whole.degree};
  }

 private:
  Part sum() {
    Part left = product();
    while (token().is('+') || token().is('-')) {
      const FormulaToken op = take();
      const Part right = product();
      const bool polynomial = left.degree >= 0 && right.degree >= 0;
      emit(op.is('+') ? Kind::add : Kind::subtract);
      left = joined(left, right, polynomial ? std::max(left.degree, right.degree) : not_polynomial, op);
    }
    return left;
  }

  Part product() {
    Part left = signed_power();
    while (token().is('*') || token().is('/')) {
      const FormulaToken op = take();
      const Part right = signed_power();
      const bool divides = op.is('/');
      if (divides && right.constant && program_.back().number == 0.0)
        throw formula_error(text_, op.position, "this divides by zero");
      const bool polynomial = left.degree >= 0 && (divides ? right.constant : right.degree >= 0);
      emit(divides ? Kind::divide : Kind::multiply);
      left = joined(left, right, polynomial ? left.degree + right.degree : not_polynomial, op);
    }
    return left;
  }

  Part signed_power() {
    const FormulaToken first = token();
    bool negative = false;
    while (token().is('+') || token().is('-')) negative ^= take().is('-');
    Part part = power();
    if (!negative) return part;
    emit(Kind::negate);
    return folded(part, first.position);
  }

  Part power() {
    const Part base = value();
    if (!token().is('^')) return base;
    const FormulaToken op = take();
    const Descent descent(*this);
    // Derivatives of towers of powers grow with every floor beyond all bounds.
    if (++floors_ > highest_tower)
      throw error(fmt::format("exponents stand in exponents more than {} deep", highest_tower));
    const Part exponent = signed_power();
    --floors_;
    const double number = program_.back().number;
    // 2, 2.0 and 4/2 are the same exponent: only as a whole number does it make a polynomial.
    if (exponent.constant && number == std::floor(number) && std::abs(number) <= 1e6) {
      program_.pop_back();
      program_.push_back({.kind = Kind::whole_power, .index = static_cast<int>(number)});
      const bool polynomial = base.degree >= 0 && number >= 0;
      // no overflow: degree ≤ 64, exponent ≤ 10⁶
      return joined(base, base, polynomial ? base.degree * static_cast<int>(number) : not_polynomial, op);
    }
    emit(Kind::power);
    return joined(base, exponent, base.constant && exponent.constant ? 0 : not_polynomial, op);
  }

  Part value() {
    const FormulaToken first = token();
    const std::size_t begin = program_.size();
    if (first.kind == FormulaToken::Kind::end) throw error("the formula ends where a value is expected");
    if (!first.starts_value()) throw error(fmt::format("'{}' stands where a value is expected", first.text));
    take();
    Part part{.begin = begin, .position = first.position, .degree = 0, .constant = true};
    if (first.is('(')) {
      part = enclosed(first);
      part.position = first.position;
    } else if (first.kind == FormulaToken::Kind::number) {
      program_.push_back({.kind = Kind::number, .number = first.value});
    } else {
      part = named(first);
    }
    refuse_implicit_product();
    return part;
  }

  Part enclosed(const FormulaToken& open) {
    const Descent descent(*this);
    const Part part = sum();
    if (token().is(',')) throw error("a comma stands between arguments only; decimals are written with a point: 0.5");
    close(open);
    return part;
  }

  Part named(const FormulaToken& name) {
    const std::size_t begin = program_.size();
    const auto variable = std::find(variables_.begin(), variables_.end(), name.text);
    if (variable != variables_.end()) {
      program_.push_back({.kind = Kind::variable, .index = static_cast<int>(variable - variables_.begin())});
      return {.begin = begin, .position = name.position, .degree = 1, .constant = false};
    }
    if (const auto constant = constants_.find(std::string(name.text)); constant != constants_.end()) {
      program_.push_back({.kind = Kind::number, .number = constant->second});
      return {.begin = begin, .position = name.position, .degree = 0, .constant = true};
    }
    if (name.text == "j" && has_index()) return index(name);
    if (name.text == "pi" || name.text == "Pi") {
      program_.push_back({.kind = Kind::number, .number = std::numbers::pi});
      return {.begin = begin, .position = name.position, .degree = 0, .constant = true};
    }
    const FormulaFunction* function = find_formula_function(name.text);
    if (function == nullptr) throw unknown(name);
    return call(name, *function);
  }

  bool has_index() const {
    return constants_.contains(index_before_line) &&
           std::find(variables_.begin(), variables_.end(), "x") != variables_.end();
  }

  // j = x/dx + its value before the line, to the nearest whole number: behind so large a one doubles have no fractions.
  Part index(const FormulaToken& name) {
    const std::size_t begin = program_.size();
    const auto x = std::find(variables_.begin(), variables_.end(), "x");
    program_.push_back({.kind = Kind::variable, .index = static_cast<int>(x - variables_.begin())});
    program_.push_back({.kind = Kind::number, .number = constants_.at("dx")});
    emit(Kind::divide);
    program_.push_back({.kind = Kind::number, .number = constants_.at(index_before_line)});
    emit(Kind::add);
    constexpr double without_fractions = 0x1.8p52;
    for (const Kind there_and_back : {Kind::add, Kind::subtract}) {
      program_.push_back({.kind = Kind::number, .number = without_fractions});
      emit(there_and_back);
    }
    return {.begin = begin, .position = name.position, .degree = 1, .constant = false};
  }

  Part call(const FormulaToken& name, const FormulaFunction& function) {
    if (!token().is('(')) throw error(fmt::format("the argument of {0} stands in parentheses: {0}(…)", function.name));
    const FormulaToken open = take();
    const Descent descent(*this);
    const std::size_t begin = program_.size();
    bool constant = true;
    int count = 0;
    if (!token().is(')')) {
      do {
        if (count > 0) take();
        constant = sum().constant && constant;
        ++count;
      } while (token().is(','));
    }
    close(open);
    if (count != function.arity)
      throw formula_error(text_, name.position,
                          fmt::format("{} takes {} argument{}, not {}", function.name, function.arity,
                                      function.arity == 1 ? "" : "s", count));
    if (!constant && !may_vary(function))
      throw formula_error(text_, name.position,
                          fmt::format("{} has no derivative, and forces are derivatives of the energy", function.name));
    program_.push_back({.kind = Kind::call, .function = &function});
    return folded(
        {.begin = begin, .position = name.position, .degree = constant ? 0 : not_polynomial, .constant = constant},
        name.position);
  }

  void close(const FormulaToken& open) {
    if (token().is(')')) {
      take();
    } else {
      throw formula_error(text_, open.position, "this parenthesis is not closed");
    }
  }

  void refuse_implicit_product() const {
    const FormulaToken& next = token();
    if (!next.starts_value()) return;
    const FormulaToken& last = tokens_[at_ - 1];
    if (last.kind == FormulaToken::Kind::number && next.kind == FormulaToken::Kind::number)
      throw error(
          fmt::format("two numbers stand side by side: '{}' and '{}'", shortened(last.text), shortened(next.text)));
    if (last.kind == FormulaToken::Kind::number && is_unit(next.text) && !is_known(next.text))
      throw error(fmt::format("units such as {} are not part of the language: numbers are in those of the equation",
                              next.text));
    if (next.kind == FormulaToken::Kind::name && !is_known(next.text) && !spelling_here(next.text).empty())
      throw unknown(next);
    const bool called = last.kind == FormulaToken::Kind::name && next.is('(');
    if (!called)
      throw error(
          fmt::format("a multiplication sign is missing: write {}*{}", shortened(last.text), shortened(next.text)));
    const std::string hint = is_index(tokens_[at_ + 1]) ? hint_on_neighbours(last.text, variables_) : "";
    throw error(hint.empty() ? fmt::format("{0} is not a function; for a product write {0}*(…)", shortened(last.text))
                             : fmt::format("{} has no index: {}", shortened(last.text), hint));
  }

  // As j in u(j+1); a name that means something else makes a product of it.
  bool is_index(const FormulaToken& token) const {
    constexpr std::array<std::string_view, 4> letters = {"i", "j", "k", "n"};
    return std::find(letters.begin(), letters.end(), token.text) != letters.end() &&
           (token.text == "j" || !is_known(token.text));
  }

  bool is_known(std::string_view name) const {
    return std::find(variables_.begin(), variables_.end(), name) != variables_.end() ||
           constants_.contains(std::string(name)) || (name == "j" && has_index()) ||
           find_formula_function(name) != nullptr;
  }

  Error unknown(const FormulaToken& name) const {
    if (const std::string_view here = spelling_here(name.text); !here.empty())
      return formula_error(text_, name.position,
                           fmt::format("there is no '{}'{} {}", name.text, here.starts_with("write") ? ';' : ':',
                                       here));
    std::vector<std::string> names = variables_;
    std::erase(names, "");  // arguments that this formula has no name for
    for (const auto& [constant, value] : constants_)
      if (constant != index_before_line) names.push_back(constant);
    if (has_index() && std::find(names.begin(), names.end(), "j") == names.end()) names.emplace_back("j");
    names.emplace_back("pi");
    for (const FormulaFunction& function : formula_functions())
      if (may_vary(function)) names.emplace_back(function.name);
    const bool is_called = token().is('(');
    const bool is_near_another = is_called || !nearest_name(name.text, names).empty();
    const std::string said = advice_ ? advice_(shortened(name.text), is_near_another) : "";
    if (said.empty() && is_called) return unknown_function(name);
    if (said.empty()) return formula_error(text_, name.position, unknown_name("name", name.text, names).what());
    return formula_error(text_, name.position,
                         fmt::format("unknown name '{}': {}. Allowed: {}", shortened(name.text), said,
                                     fmt::join(names, ", ")));
  }

  Error unknown_function(const FormulaToken& name) const {
    std::vector<std::string> names;
    for (const FormulaFunction& function : formula_functions())
      if (may_vary(function)) names.emplace_back(function.name);
    if (!nearest_name(name.text, names).empty())
      return formula_error(text_, name.position, unknown_name("function", name.text, names).what());
    return formula_error(text_, name.position,
                         fmt::format("unknown function '{0}': write out what {0}( ) is, or {0}*( ) for a product. "
                                     "Allowed: {1}",
                                     shortened(name.text), fmt::join(names, ", ")));
  }

  bool may_vary(const FormulaFunction& function) const {
    return allowed_ == FunctionsAllowed::all || function.differentiable;
  }

  Part joined(const Part& left, const Part& right, int degree, const FormulaToken& op) {
    if (degree > highest_degree)
      throw formula_error(text_, op.position,
                          fmt::format("this makes a polynomial of degree {}; at most {}", degree, highest_degree));
    return folded(
        {.begin = left.begin, .position = left.position, .degree = degree, .constant = left.constant && right.constant},
        op.position);
  }

  // A constant becomes one number, and one that is not finite is refused where the user can see why.
  Part folded(const Part& part, std::size_t position) {
    if (!part.constant) return part;
    const auto begin = program_.begin() + static_cast<std::ptrdiff_t>(part.begin);
    const double number = run_program(std::span<const Instruction>(begin, program_.end()), {});
    if (!std::isfinite(number)) throw formula_error(text_, position, "the value of this is not a finite real number");
    program_.erase(begin, program_.end());
    program_.push_back({.kind = Kind::number, .number = number});
    return part;
  }

  // One level of recursion, so that no input can exhaust the stack.
  struct Descent {
    explicit Descent(Parser& owner) : parser(owner) {
      if (++parser.depth_ > deepest_nesting)
        throw parser.error(fmt::format("the formula is nested more than {} deep", deepest_nesting));
    }
    ~Descent() { --parser.depth_; }
    Descent(const Descent&) = delete;
    Descent& operator=(const Descent&) = delete;
    Parser& parser;
  };

  const FormulaToken& token() const { return tokens_[at_]; }
  FormulaToken take() { return tokens_[at_++]; }
  Error error(std::string_view sentence) const { return formula_error(text_, token().position, sentence); }
  void emit(Kind kind) { program_.push_back({.kind = kind}); }

  std::string_view text_;
  const std::vector<std::string>& variables_;
  const FormulaConstants& constants_;
  const NameAdvice& advice_;
  FunctionsAllowed allowed_;
  std::vector<FormulaToken> tokens_;
  std::size_t at_ = 0;
  int depth_ = 0, floors_ = 0;
  FormulaProgram program_;
};

}  // namespace

ParsedFormula parse_formula(std::string_view text, const std::vector<std::string>& variables,
                            const FormulaConstants& constants, const NameAdvice& advice, FunctionsAllowed allowed) {
  return Parser(text, variables, constants, advice, allowed).parse();
}

}  // namespace seiche
