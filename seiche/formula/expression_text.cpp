#include <seiche/formula/algebra_functions.hpp>
#include <seiche/formula/expression_text.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace seiche {
namespace {

// The number that a short decimal, such as -0.125, says.
GiNaC::numeric exactly(std::string decimal) {
  const std::size_t point = decimal.find('.');
  if (point == std::string::npos) return GiNaC::numeric(decimal.c_str());
  const auto places = static_cast<long>(decimal.size() - point - 1);
  decimal.erase(point, 1);
  return GiNaC::numeric(decimal.c_str()) / GiNaC::pow(GiNaC::numeric(10), GiNaC::numeric(places));
}

// A decimal where it says the number exactly, else a fraction.
std::string text_of_number(const GiNaC::numeric& x) {
  std::ostringstream exact;
  exact << x;
  if (x.is_integer() || !x.is_rational()) return exact.str();
  const std::string decimal = fmt::format("{}", x.to_double());
  constexpr std::size_t longest_decimal = 12;
  const bool is_short =
      decimal.size() <= longest_decimal && decimal.find_first_not_of("-.0123456789") == std::string::npos;
  if (is_short && exactly(decimal).is_equal(x)) return decimal;
  constexpr std::size_t longest = 24;  // an irrational number written as a double
  return exact.str().size() <= longest ? exact.str() : decimal;
}

bool is_sum(const Expression& e) { return GiNaC::is_a<GiNaC::add>(e); }

std::string in_parentheses_if(bool wanted, const std::string& text) { return wanted ? "(" + text + ")" : text; }

struct Operand {
  std::string text;
  Expression expression;
};

std::vector<Operand> ordered(const Expression& expression) {
  std::vector<Operand> operands;
  for (std::size_t i = 0; i < expression.nops(); ++i) operands.push_back({text_of(expression.op(i)), expression.op(i)});
  std::stable_sort(operands.begin(), operands.end(),
                   [](const Operand& a, const Operand& b) { return a.text < b.text; });
  return operands;
}

std::string text_of_sum(const Expression& sum) {
  std::string text;
  for (const Operand& term : ordered(sum)) {
    const bool is_negative = term.text.starts_with('-');
    text += text.empty() ? term.text : is_negative ? " - " + term.text.substr(1) : " + " + term.text;
  }
  return text;
}

// The number first.
std::string text_of_product(const Expression& product) {
  std::string number, factors;
  for (const Operand& factor : ordered(product)) {
    if (GiNaC::is_a<GiNaC::numeric>(factor.expression)) {
      number = factor.text == "1" ? "" : factor.text == "-1" ? "-" : factor.text + "*";
    } else {
      factors += (factors.empty() ? "" : "*") + in_parentheses_if(is_sum(factor.expression), factor.text);
    }
  }
  return number + factors;
}

std::string text_of_power(const Expression& power) {
  const Expression& base = power.op(0);
  const Expression& exponent = power.op(1);
  if (exponent.is_equal(GiNaC::numeric(1, 2))) return fmt::format("sqrt({})", text_of(base));
  const bool is_plain =
      GiNaC::is_a<GiNaC::symbol>(base) || GiNaC::is_a<GiNaC::function>(base) || base.info(GiNaC::info_flags::nonnegint);
  return fmt::format("{}^{}", in_parentheses_if(!is_plain, text_of(base)),
                     in_parentheses_if(!exponent.info(GiNaC::info_flags::nonnegint), text_of(exponent)));
}

}  // namespace

std::vector<Expression> in_one_order(const Expression& expression) {
  std::vector<Expression> expressions;
  for (Operand& operand : ordered(expression)) expressions.push_back(std::move(operand.expression));
  return expressions;
}

std::string text_of(const Expression& expression) {
  if (is_sum(expression)) return text_of_sum(expression);
  if (GiNaC::is_a<GiNaC::mul>(expression)) return text_of_product(expression);
  if (GiNaC::is_a<GiNaC::power>(expression)) return text_of_power(expression);
  if (GiNaC::is_a<GiNaC::numeric>(expression)) return text_of_number(GiNaC::ex_to<GiNaC::numeric>(expression));
  if (GiNaC::is_a<GiNaC::function>(expression)) {
    std::vector<std::string> arguments;
    for (std::size_t i = 0; i < expression.nops(); ++i) arguments.push_back(text_of(expression.op(i)));
    return fmt::format("{}({})", name_of_function(expression), fmt::join(arguments, ", "));
  }
  std::ostringstream text;
  text << expression;
  return text.str();
}

}  // namespace seiche
