// Formulas that vanish at rest lose no digits there, and what round-off makes of a formula is bounded.
#include <seiche/core/base/vector.hpp>
#include <seiche/formula/cancellation.hpp>
#include <seiche/formula/expression_slopes.hpp>
#include <seiche/formula/formula_compiler.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>

namespace seiche::test {
namespace TEST_FILE {

using Long = long double;  // with 64 bits of a mantissa where tests run, or as many as double

// The program itself, in long double.
Long evaluated(std::span<const Instruction> program, std::span<const double> at) {
  using Kind = Instruction::Kind;
  static const std::map<std::string_view, std::function<Long(Long)>> functions = {
      {"sin", [](Long x) { return std::sin(x); }},       {"cos", [](Long x) { return std::cos(x); }},
      {"tan", [](Long x) { return std::tan(x); }},       {"asin", [](Long x) { return std::asin(x); }},
      {"acos", [](Long x) { return std::acos(x); }},     {"atan", [](Long x) { return std::atan(x); }},
      {"sinh", [](Long x) { return std::sinh(x); }},     {"cosh", [](Long x) { return std::cosh(x); }},
      {"tanh", [](Long x) { return std::tanh(x); }},     {"asinh", [](Long x) { return std::asinh(x); }},
      {"acosh", [](Long x) { return std::acosh(x); }},   {"atanh", [](Long x) { return std::atanh(x); }},
      {"exp", [](Long x) { return std::exp(x); }},       {"expm1", [](Long x) { return std::expm1(x); }},
      {"log", [](Long x) { return std::log(x); }},       {"log1p", [](Long x) { return std::log1p(x); }},
      {"sqrt", [](Long x) { return std::sqrt(x); }},     {"abs", [](Long x) { return std::abs(x); }},
      {"sech", [](Long x) { return 1 / std::cosh(x); }}, {"sign", [](Long x) { return std::copysign(Long{1}, x); }}};
  std::vector<Long> stack;
  const auto pop = [&stack] {
    const Long top = stack.back();
    stack.pop_back();
    return top;
  };
  for (const Instruction& i : program) {
    if (i.kind == Kind::number) {
      stack.push_back(i.number);
    } else if (i.kind == Kind::variable) {
      stack.push_back(at[static_cast<std::size_t>(i.index)]);
    } else if (i.kind == Kind::negate) {
      stack.push_back(-pop());
    } else if (i.kind == Kind::whole_power) {
      stack.push_back(std::pow(pop(), i.index));
    } else if (i.kind == Kind::call) {
      stack.push_back(functions.at(i.function->name)(pop()));
    } else {
      const Long b = pop(), a = pop();
      stack.push_back(i.kind == Kind::add        ? a + b
                      : i.kind == Kind::subtract ? a - b
                      : i.kind == Kind::multiply ? a * b
                      : i.kind == Kind::divide   ? a / b
                                                 : std::pow(a, b));
    }
  }
  return stack.back();
}

const std::vector<std::string> names = {"u", "v"};

// Beside a formula its form without cancellation, by hand, to be evaluated in long double.
struct Pair {
  std::string formula;
  std::function<Long(Long, Long)> exact;
};

const std::vector<Pair>& pairs() {
  static const std::vector<Pair> list = {
      {"log(1 + u^2)", [](Long u, Long) { return std::log1p(u * u); }},
      {"3*log(1 + 2*u^2 + v^4)", [](Long u, Long v) { return 3 * std::log1p(2 * u * u + v * v * v * v); }},
      {"log(cosh(u - v))", [](Long u, Long v) { return std::log1p(2 * std::pow(std::sinh((u - v) / 2), 2)); }},
      {"(1 - exp(-u))^2", [](Long u, Long) { return std::pow(std::expm1(-u), 2); }},
      {"2*exp(u) - 2", [](Long u, Long) { return 2 * std::expm1(u); }},
      {"u^2/2 + (1 - cos(3*v))/9", [](Long u, Long v) { return u * u / 2 + 2 * std::pow(std::sin(3 * v / 2), 2) / 9; }},
      {"cosh(u) - cos(v)",
       [](Long u, Long v) { return 2 * std::pow(std::sinh(u / 2), 2) + 2 * std::pow(std::sin(v / 2), 2); }},
      {"sqrt(1 + u^2) - 1", [](Long u, Long) { return u * u / (std::sqrt(1 + u * u) + 1); }},
      {"5*(sqrt(4 + u^2 + v^2) - 2)",
       [](Long u, Long v) { return 5 * (u * u + v * v) / (std::sqrt(4 + u * u + v * v) + 2); }},
      {"3 - 2*cos(u) - sqrt(1 + v^2)",
       [](Long u, Long v) { return 4 * std::pow(std::sin(u / 2), 2) - v * v / (std::sqrt(1 + v * v) + 1); }},
  };
  return list;
}

TEST(Cancellation, LosesNoDigitsWhereAFormulaVanishes) {
  std::mt19937_64 bits(5);
  std::uniform_real_distribution<double> exponent(-12, 0.3), sign(-1, 1);
  for (const auto& [text, exact] : pairs()) {
    const FormulaPointer formula = compile_formula(text, names);
    const FormulaProgram program = without_cancellation(formula->program());
    for (int i = 0; i < 200; ++i) {
      const double u = std::copysign(std::pow(10, exponent(bits)), sign(bits));
      const double v = std::copysign(0.1 * u, sign(bits));
      const std::array at = {u, v};
      const Long right = exact(u, v);
      EXPECT_LE(std::abs(run_program(program, at) - right), 20 * epsilon * std::abs(right)) << text << " at " << u;
    }
  }
}

TEST(Cancellation, OfTanhSquaredAtInfinityIsAvoidedToo) {
  const FormulaPointer slope = differentiate(*compile_formula("3*tanh(u)", {"u"}), "u");
  const FormulaProgram program = without_cancellation(slope->program());
  for (const double u : {1e-8, 0.5, 3.0, 20.0, 300.0}) {
    const double right = 3 / (std::cosh(u) * std::cosh(u));
    EXPECT_NEAR(run_program(program, {{u}}), right, 20 * epsilon * right) << u;
  }
}

// Far from rest, where exponentials vanish and constants are small beside what they stand next to.
TEST(Cancellation, LosesNothingFarFromRest) {
  const std::vector<std::pair<std::string, std::function<Long(Long)>>> list = {
      {"log(0.5*exp(-(u-3)^2) + 0.5*exp(-(u+3)^2))",
       [](Long u) { return std::log(std::exp(-(u - 3) * (u - 3)) / 2 + std::exp(-(u + 3) * (u + 3)) / 2); }},
      {"2*exp(-u) - 2*exp(-2*u)", [](Long u) { return 2 * std::exp(-u) * -std::expm1(-u); }},
      {"log(0.25*exp(-u) + 0.75*exp(-2*u))",
       [](Long u) { return std::log(std::exp(-u) / 4 + 3 * std::exp(-2 * u) / 4); }}};
  for (const auto& [text, exact] : list) {
    const FormulaProgram program = without_cancellation(compile_formula(text, {"u"})->program());
    for (const double u : {5.0, 8.5, 10.0, 20.0}) {
      const Long right = exact(u);
      EXPECT_LE(std::abs(run_program(program, {{u}}) - right), 1e-14L * std::abs(right)) << text << " at " << u;
    }
  }
  const FormulaPointer small = compile_formula("1e8*cos(u) - 1e8*cos(u) + 5e-8", {"u"});
  EXPECT_EQ(run_program(without_cancellation(small->program()), {{0.0}}), 5e-8);
}

TEST(Cancellation, LeavesOtherFormulasAsTheyAre) {
  for (const char* text :
       {"u^2/2 - v^4/4 + 1", "exp(u) + exp(-u)", "exp(u) - 2", "log(2 + u^2)", "log(u) - 1", "u*cos(v) - 1",
        "1 - tanh(u)", "sqrt(u^2 + v^2) - 1", "sqrt(1 + u^2) + 1", "u - (v - 1)/3"}) {
    const FormulaPointer formula = compile_formula(text, names);
    const FormulaProgram program = without_cancellation(formula->program());
    ASSERT_EQ(program.size(), formula->program().size()) << text;
    for (std::size_t i = 0; i < program.size(); ++i) {
      EXPECT_EQ(program[i].kind, formula->program()[i].kind) << text;
      EXPECT_EQ(program[i].function, formula->program()[i].function) << text;
      EXPECT_EQ(program[i].number, formula->program()[i].number) << text;
    }
  }
}

// Of values and of derivatives, near points where terms cancel and far from them; u and v are exact here.
TEST(ErrorBounds, HoldWhateverCancelsAndAreNotFarTooLarge) {
  constexpr std::size_t block = ExpressionGraph::block;
  const std::vector<std::string> formulas = {"(1 + u)^(-12) - 2*(1 + u)^(-6) + 1",
                                             "exp(u) - u - 1",
                                             "log(1 + u^2)/(2 + v)",
                                             "(u^2 - v^2)*(u - v) + 1 - cos(u*v)",
                                             "sqrt((u - v)^2 + u^4)*tanh(u)",
                                             "asin(u/3)*acos(v/3) - atan(u)*asinh(v)",
                                             "sinh(u)*tan(v/2) - sech(u)^2 + cosh(v)",
                                             "(2 + u)^(1.5 + v) - (2 + v)^1.5",
                                             "acosh(3 + u) - atanh(v/3) + abs(u - v)",
                                             "exp(-u^2) - expm1(v)*log1p(u^2)"};
  std::mt19937_64 bits(7);
  std::uniform_real_distribution<double> exponent(-9, -0.1), sign(-1, 1);
  double tightest = 0;
  for (const std::string& text : formulas) {
    const FormulaPointer formula = compile_formula(text, names);
    const FormulaPointer by_u = differentiate(*formula, "u"), by_v = differentiate(*formula, "v");
    const std::vector<std::span<const Instruction>> programs = {formula->program(), by_u->program(), by_v->program()};
    const ExpressionGraph graph(2, programs);
    std::vector<double> table(graph.table_size()), bounds(graph.table_size());
    graph.set_numbers(table.data());
    for (std::size_t j = 0; j < block; ++j) {
      table[j] = std::copysign(std::pow(10, exponent(bits)), sign(bits));
      table[block + j] = j % 2 == 0 ? table[j] * (1 + 1e-6 * sign(bits)) : sign(bits);
    }
    graph.evaluate(table.data(), block);
    error_bounds(graph, table.data(), block, graph.nodes().size(), bounds.data());
    for (std::size_t p = 0; p < programs.size(); ++p) {
      for (std::size_t j = 0; j < block; ++j) {
        const std::size_t at = graph.output(p) * block + j;
        const std::array point = {table[j], table[block + j]};
        const Long error = std::abs(evaluated(programs[p], point) - table[at]);
        ASSERT_LE(error, epsilon * bounds[at]) << text << ", program " << p << " at " << point[0] << ", " << point[1];
        tightest = std::max(tightest, static_cast<double>(error / (epsilon * bounds[at] + 1e-300)));
      }
    }
  }
  EXPECT_GT(tightest, 0.1);
}

TEST(ErrorBounds, AreThoseOfTheValueWhereThereIsNone) {
  const FormulaPointer formula = compile_formula("1/cosh(u) + sqrt(v)", names);
  const std::vector<std::span<const Instruction>> programs = {formula->program()};
  const ExpressionGraph graph(2, programs);
  std::vector<double> table(graph.table_size()), bounds(graph.table_size());
  graph.set_numbers(table.data());
  table[0] = 900;  // cosh is infinite
  table[ExpressionGraph::block] = 0;
  graph.evaluate(table.data(), 1);
  error_bounds(graph, table.data(), 1, graph.nodes().size(), bounds.data());
  EXPECT_EQ(table[graph.output(0) * ExpressionGraph::block], 0);
  EXPECT_EQ(bounds[graph.output(0) * ExpressionGraph::block], 0);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
