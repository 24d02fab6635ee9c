// Formulas as a graph: values, and differences without cancellation.
#include <seiche/formula/expression_slopes.hpp>
#include <seiche/formula/formula_compiler.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace seiche::test {
namespace TEST_FILE {

constexpr std::size_t block = ExpressionGraph::block;

const std::vector<std::string>& three() {
  static const std::vector<std::string> names = {"u", "v", "w"};
  return names;
}

ExpressionGraph graph_of(const std::vector<FormulaPointer>& formulas) {
  std::vector<std::span<const Instruction>> programs;
  for (const FormulaPointer& formula : formulas) programs.push_back(formula->program());
  return {3, programs};
}

// Where all of them are real.
const std::vector<std::string>& formulas_in_three_variables() {
  static const std::vector<std::string> list = {
      "u*v - w/(1 + u^2) + 3",
      "sin(u)*cos(v) + tan(w/4)",
      "sinh(u - v)*cosh(w)*tanh(u)*sech(v)",
      "exp(-u^2)*log(2 + v^2) - sqrt(1 + w^2)",
      "asin(u/4) + acos(v/4) + atan(w) + asinh(u*v)",
      "acosh(3 + u) + atanh(v/5)",
      "(2 + u^2)^1.5 + (1.5 + v^2)^(w/3)",
      "u^7 - 3*v^-3*w^2 + (u + v + w)^4",
      "abs(u)*v - abs(w - 5)",
      "u^2*v - v^3/3 + u*v*w",
  };
  return list;
}

using Point = std::array<double, 3>;

std::vector<Point> points(std::size_t count) {
  std::mt19937_64 bits(3);
  std::uniform_real_distribution<double> u(0.2, 1.4), v(-1.5, -0.3), w(-1, 1);
  std::vector<Point> list;
  for (std::size_t i = 0; i < count; ++i) list.push_back({u(bits), v(bits), w(bits)});
  return list;
}

std::vector<double> table_at(const ExpressionGraph& graph, const std::vector<Point>& places) {
  std::vector<double> table(graph.table_size());
  graph.set_numbers(table.data());
  for (std::size_t v = 0; v < 3; ++v)
    for (std::size_t j = 0; j < places.size(); ++j) table[v * block + j] = places[j][v];
  graph.evaluate(table.data(), places.size());
  return table;
}

TEST(ExpressionGraph, ItsValuesAreThoseOfTheFormulas) {
  std::vector<FormulaPointer> formulas;
  for (const std::string& text : formulas_in_three_variables()) formulas.push_back(compile_formula(text, three()));
  formulas.push_back(compile_formula("min(u, w) + max(v, -1)", three()));
  const ExpressionGraph graph = graph_of(formulas);
  const std::vector<Point> places = points(37);
  const std::vector<double> table = table_at(graph, places);
  for (std::size_t f = 0; f < formulas.size(); ++f)
    for (std::size_t j = 0; j < places.size(); ++j) {
      const double expected = (*formulas[f])(places[j]);
      EXPECT_NEAR(table[graph.output(f) * block + j], expected, 4e-15 * (1 + std::abs(expected)))
          << formulas[f]->text();
    }
}

TEST(ExpressionGraph, WhatFormulasShareIsThereOnce) {
  const ExpressionGraph one = graph_of({compile_formula("sin(u*v) + 1", three())});
  const ExpressionGraph two =
      graph_of({compile_formula("sin(u*v) + 1", three()), compile_formula("1 + sin(v*u)", three())});
  EXPECT_EQ(two.nodes().size(), one.nodes().size());
  EXPECT_EQ(two.output(0), two.output(1));
}

TEST(ExpressionGraph, SlopesTimesTheStepAreTheDifferenceForStepsOfAnyLength) {
  const std::vector<Point> from = points(20);
  for (const std::string& text : formulas_in_three_variables()) {
    const FormulaPointer formula = compile_formula(text, three());
    const ExpressionGraph graph = graph_of({formula});
    for (const double length : {1e-12, 1e-7, 1e-3, 0.04, 0.2, 0.6}) {
      std::vector<Point> to = from;
      for (Point& place : to) place = {place[0] + length / 2, place[1] - length / 3, place[2] + length};
      const std::vector<double> a = table_at(graph, from), b = table_at(graph, to);
      std::vector<double> slopes(3 * graph.table_size()), back(3 * graph.table_size());
      mean_slopes(graph, a.data(), b.data(), 3, from.size(), slopes.data());
      mean_slopes(graph, b.data(), a.data(), 3, from.size(), back.data());
      for (std::size_t j = 0; j < from.size(); ++j) {
        double sum = 0, size = 0;
        for (std::size_t v = 0; v < 3; ++v) {
          const double slope = slopes[(graph.output(0) * 3 + v) * block + j];
          EXPECT_NEAR(back[(graph.output(0) * 3 + v) * block + j], slope, 1e-12 * (1 + std::abs(slope))) << text;
          sum += slope * (to[j][v] - from[j][v]);
          size += std::abs(slope);
        }
        const double fa = (*formula)(from[j]), fb = (*formula)(to[j]);
        EXPECT_NEAR(sum, fb - fa, 4e-15 * (1 + std::abs(fa) + std::abs(fb)) + 2e-14 * size * length)
            << text << ", length " << length;
      }
    }
  }
}

TEST(ExpressionGraph, SlopesFromAPointToItselfAreTheGradient) {
  const std::vector<Point> places = points(20);
  for (const std::string& text : formulas_in_three_variables()) {
    const FormulaPointer formula = compile_formula(text, three());
    const ExpressionGraph graph = graph_of({formula});
    const std::vector<double> table = table_at(graph, places);
    std::vector<double> slopes(3 * graph.table_size());
    mean_slopes(graph, table.data(), table.data(), 3, places.size(), slopes.data());
    for (std::size_t v = 0; v < 3; ++v) {
      const FormulaPointer derivative = differentiate(*formula, three()[v]);
      for (std::size_t j = 0; j < places.size(); ++j) {
        const double expected = (*derivative)(places[j]);
        EXPECT_NEAR(slopes[(graph.output(0) * 3 + v) * block + j], expected, 4e-14 * (1 + std::abs(expected))) << text;
      }
    }
  }
}

// Each against the difference in extended precision, down to steps where a plain difference has no digit left.
TEST(ExpressionGraph, MeanSlopesOfFunctionsLoseNoDigits) {
  struct Known {
    const char* name;
    long double (*f)(long double);
    double a;
  };
  const std::vector<Known> known = {
      {"sin", [](long double x) { return std::sin(x); }, 0.7},
      {"cos", [](long double x) { return std::cos(x); }, 0.7},
      {"tan", [](long double x) { return std::tan(x); }, 0.7},
      {"asin", [](long double x) { return std::asin(x); }, 0.3},
      {"acos", [](long double x) { return std::acos(x); }, 0.3},
      {"atan", [](long double x) { return std::atan(x); }, 0.7},
      {"sinh", [](long double x) { return std::sinh(x); }, 0.7},
      {"cosh", [](long double x) { return std::cosh(x); }, 0.7},
      {"tanh", [](long double x) { return std::tanh(x); }, 0.7},
      {"asinh", [](long double x) { return std::asinh(x); }, 0.7},
      {"acosh", [](long double x) { return std::acosh(x); }, 1.7},
      {"atanh", [](long double x) { return std::atanh(x); }, 0.3},
      {"exp", [](long double x) { return std::exp(x); }, 0.7},
      {"log", [](long double x) { return std::log(x); }, 0.7},
      {"expm1", [](long double x) { return std::expm1(x); }, 0.7},
      {"log1p", [](long double x) { return std::log1p(x); }, 0.7},
      {"sqrt", [](long double x) { return std::sqrt(x); }, 0.7},
      {"abs", [](long double x) { return std::fabs(x); }, 0.7},
      {"sign", [](long double x) -> long double { return x == 0 ? 0 : std::copysign(1.0L, x); }, -0.1},
      {"step", [](long double x) -> long double { return x == 0  ? 0.5L
                                                         : x > 0 ? 1
                                                                 : 0; }, -0.1},
      {"sech", [](long double x) { return 1 / std::cosh(x); }, 0.7},
  };
  for (const FormulaFunction& function : formula_functions()) {
    if (function.arity != 1) continue;
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const Known& k) { return function.name == k.name; });
    ASSERT_NE(found, known.end()) << function.name;
    for (const double length : {1e-6, 1e-4, 1e-2, 0.1, 0.3}) {
      const double b = found->a + length;
      const long double d = static_cast<long double>(b) - found->a;
      const auto expected = static_cast<double>((found->f(b) - found->f(found->a)) / d);
      // A difference in extended precision is good to 1e-19 over its length.
      EXPECT_NEAR(function.mean_slope(found->a, b), expected, 3e-14 + 4e-19 / length) << function.name << " " << length;
      EXPECT_NEAR(function.mean_slope(b, found->a), expected, 3e-14 + 4e-19 / length) << function.name << " " << length;
    }
    if (function.mean_slopes == nullptr) continue;
    std::vector<double> a, b, slopes;
    for (int i = 0; i < 300; ++i) {
      a.push_back(found->a + 0.01 * (i - 150));
      b.push_back(a.back() + (i % 3 - 1) * std::pow(10.0, -18 + i / 15.0));
    }
    slopes.resize(a.size());
    function.mean_slopes(a.data(), b.data(), slopes.data(), a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double alone = function.mean_slope(a[i], b[i]);
      EXPECT_NEAR(slopes[i], alone, 6 * epsilon * (1 + std::abs(alone))) << function.name << " " << a[i] << " " << b[i];
    }
  }
}

// Far from 0, where functions level out or grow without end, and next to where they end.
TEST(ExpressionGraph, MeanSlopesHoldFarAwayAndNextToTheEnds) {
  struct Place {
    const char* name;
    double a, b;
    long double expected;
  };
  using Long = long double;
  const auto difference = [](auto f, double a, double b) { return (f(Long(b)) - f(Long(a))) / (Long(b) - Long(a)); };
  const auto tanh_difference = [](double a, double b) {  // of e^{−2x}, which does not level out
    const Long ea = std::exp(-2 * Long(a)), eb = std::exp(-2 * Long(b));
    return 2 * (ea - eb) / ((1 + ea) * (1 + eb)) / (Long(b) - Long(a));
  };
  const auto asin_near_one = [](double a, double b) {  // asin(1 − s) = π/2 − 2 asin √(s/2)
    const auto f = [](Long s) { return -2 * std::asin(std::sqrt(s / 2)); };
    return (f(1 - Long(b)) - f(1 - Long(a))) / (Long(b) - Long(a));
  };
  const std::vector<Place> places = {
      {"tanh", 10, 11.5, tanh_difference(10, 11.5)},
      {"tanh", 10, 40, tanh_difference(10, 40)},
      {"tanh", -1, 30, difference([](Long x) { return std::tanh(x); }, -1, 30)},
      {"atan", 1000, 1000.1, std::atan((Long(1000.1) - 1000) / (1 + Long(1000.1) * 1000)) / (Long(1000.1) - 1000)},
      {"atan", -3, 5, difference([](Long x) { return std::atan(x); }, -3, 5)},
      {"asinh", 1000, 1000.1, difference([](Long x) { return std::asinh(x); }, 1000, 1000.1)},
      {"asinh", -2, 3, difference([](Long x) { return std::asinh(x); }, -2, 3)},
      {"acosh", 1, 1.5, difference([](Long x) { return std::acosh(x); }, 1, 1.5)},
      {"acosh", 1000, 1000.5, difference([](Long x) { return std::acosh(x); }, 1000, 1000.5)},
      {"asin", 1 - 1e-9, 1 - 5e-10, asin_near_one(1 - 1e-9, 1 - 5e-10)},
      {"asin", -0.9, 0.8, difference([](Long x) { return std::asin(x); }, -0.9, 0.8)},
      {"atanh", -0.9, 0.99, difference([](Long x) { return std::atanh(x); }, -0.9, 0.99)},
  };
  for (const Place& place : places) {
    const FormulaFunction& f = *find_formula_function(place.name);
    EXPECT_NEAR(f.mean_slope(place.a, place.b) / static_cast<double>(place.expected), 1, 1e-14)
        << place.name << place.a;
    EXPECT_NEAR(f.mean_slope(place.b, place.a) / static_cast<double>(place.expected), 1, 1e-14)
        << place.name << place.a;
  }
  EXPECT_DOUBLE_EQ(find_formula_function("atanh")->mean_slope(0.5, 0.5), 1 / 0.75);
  EXPECT_DOUBLE_EQ(find_formula_function("acosh")->mean_slope(2, 2), 1 / std::sqrt(3.0));
}

TEST(ExpressionGraph, MeanSlopesOfLogarithmsAndExponentialsHoldOverManyDecades) {
  const FormulaFunction& log = *find_formula_function("log");
  for (const double b : {1e-15, 1e-9, 1e-3, 1e3, 1e9}) {
    const double expected = std::log(b) / (b - 1);
    EXPECT_NEAR(log.mean_slope(1, b), expected, 1e-14 * expected) << b;
    EXPECT_EQ(log.mean_slope(b, 1), log.mean_slope(1, b)) << b;
  }
  const FormulaFunction& exp = *find_formula_function("exp");
  EXPECT_NEAR(exp.mean_slope(-2000, 1), std::exp(1) / 2001, 1e-17);
}

TEST(ExpressionGraph, TaylorCoefficientsOfAPolynomialGiveItsValues) {
  const FormulaPointer formula = compile_formula("u^2*v - v^3/3 + (u*w - 2)^2/5 - w", three());
  const ExpressionGraph graph = graph_of({formula});
  const Point p = {0.3, -0.7, 1.1}, q = {1.2, 0.4, -0.6};
  std::vector<double> scratch(taylor_scratch_size(graph, 4)), c(5, 0.0);
  add_taylor(graph, p, q, 4, scratch.data(), c);
  for (const double x : {-1.5, 0.0, 0.3, 2.0}) {
    const Point at = {p[0] + x * q[0], p[1] + x * q[1], p[2] + x * q[2]};
    EXPECT_NEAR(c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * c[4]))), (*formula)(at), 1e-13);
  }
}

TEST(ExpressionGraph, TaylorCoefficientsKnowWhatDoesNotChangeAlongTheLine) {
  const FormulaPointer formula = compile_formula("u^4/(1 + w) + v^3*(2 + w)^-2*exp(w)/sqrt(1 + w^2)", three());
  const ExpressionGraph graph = graph_of({formula});
  const Point p = {0.3, -0.7, 1.1}, q = {1.2, 0.4, 0.0};
  std::vector<double> scratch(taylor_scratch_size(graph, 4)), c(5, 0.0);
  add_taylor(graph, p, q, 4, scratch.data(), c);
  for (const double x : {-1.5, 0.0, 0.3, 2.0}) {
    const Point at = {p[0] + x * q[0], p[1] + x * q[1], p[2]};
    EXPECT_NEAR(c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * c[4]))), (*formula)(at), 1e-13);
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
