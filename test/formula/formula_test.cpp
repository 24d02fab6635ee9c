// Formulas: they mean what the mathematics means, and whatever else is refused with its column.
#include <test/support/error_of.hpp>
#include <test/support/worst.hpp>

#include <seiche/core/base/error.hpp>
#include <seiche/formula/formula_compiler.hpp>
#include <seiche/formula/formula_parser.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace seiche {
namespace TEST_FILE {

using std::numbers::pi;
using testing::HasSubstr;

FormulaPointer in_u(const std::string& text) { return compile_formula(text, {"u"}); }

double constant(const std::string& text) { return (*compile_formula(text, {}))({}); }

std::string complaint(const std::string& text, const std::vector<std::string>& variables = {"u", "v"}) {
  return test::error_of([&] { compile_formula(text, variables); });
}

struct Known {
  std::string text;
  std::function<double(double)> f;
  double lowest = -2.0;
  double highest = 2.0;
};

std::vector<Known> known_formulas() {
  return {
      {"sin(u)", [](double u) { return std::sin(u); }},
      {"cos(3*u)", [](double u) { return std::cos(3 * u); }},
      {"tan(u)", [](double u) { return std::tan(u); }, -1.4, 1.4},
      {"asin(u)", [](double u) { return std::asin(u); }, -0.99, 0.99},
      {"acos(u)", [](double u) { return std::acos(u); }, -0.99, 0.99},
      {"atan(u)", [](double u) { return std::atan(u); }},
      {"sinh(u)", [](double u) { return std::sinh(u); }},
      {"cosh(u)", [](double u) { return std::cosh(u); }},
      {"tanh(sqrt(2)*u)/sqrt(5)", [](double u) { return std::tanh(std::sqrt(2.0) * u) / std::sqrt(5.0); }},
      {"asinh(u)", [](double u) { return std::asinh(u); }},
      {"acosh(u)", [](double u) { return std::acosh(u); }, 1.1, 3.0},
      {"atanh(u)", [](double u) { return std::atanh(u); }, -0.9, 0.9},
      {"exp(-u^2)", [](double u) { return std::exp(-u * u); }},
      {"log(u)", [](double u) { return std::log(u); }, 0.1, 3.0},
      {"sqrt(u)", [](double u) { return std::sqrt(u); }, 0.1, 3.0},
      {"abs(u)", [](double u) { return std::fabs(u); }},
      {"sech(u)", [](double u) { return 1 / std::cosh(u); }},
      {"1/(1 + u^2)", [](double u) { return 1 / (1 + u * u); }},
      {"u^-3", [](double u) { return 1 / (u * u * u); }, 0.5, 2.0},
      {"u^(1/3)", [](double u) { return std::cbrt(u); }, 0.5, 2.0},
      {"2^u", [](double u) { return std::exp2(u); }},
      {"u^u", [](double u) { return std::pow(u, u); }, 0.5, 2.0},
      {"cos(Pi*u) - 2.5e-1*u", [](double u) { return std::cos(pi * u) - u / 4; }},
      {"u*exp(u)/(2 - sin(u)^2)", [](double u) { return u * std::exp(u) / (2 - std::sin(u) * std::sin(u)); }},
      {"abs(sin(u))^3", [](double u) { return std::pow(std::fabs(std::sin(u)), 3); }},
      {"0.25*u^4 - 0.1*u^2 + u", [](double u) { return 0.25 * u * u * u * u - 0.1 * u * u + u; }},
  };
}

TEST(Formula, AgreesWithTheStandardFunctionsOnRandomPoints) {
  std::mt19937_64 random(1);
  for (const Known& known : known_formulas()) {
    const FormulaPointer formula = in_u(known.text);
    std::uniform_real_distribution<double> points(known.lowest, known.highest);
    for (int i = 0; i < 200; ++i) {
      const double u = points(random);
      const double expected = known.f(u);
      ASSERT_NEAR((*formula)(u), expected, 8e-16 * (1 + std::abs(expected))) << known.text << " at u = " << u;
    }
    EXPECT_EQ(formula->text(), known.text);
  }
}

TEST(Formula, DerivativeAgreesWithCentralDifferences) {
  std::mt19937_64 random(2);
  for (const Known& known : known_formulas()) {
    const FormulaPointer derivative = differentiate(*in_u(known.text), "u");
    const double margin = 0.02 * (known.highest - known.lowest);
    std::uniform_real_distribution<double> points(known.lowest + margin, known.highest - margin);
    for (int i = 0; i < 50; ++i) {
      const double u = points(random);
      constexpr double d = 1e-5;
      const double slope =
          (known.f(u - 2 * d) - 8 * known.f(u - d) + 8 * known.f(u + d) - known.f(u + 2 * d)) / (12 * d);
      if (known.text.starts_with("abs") && std::abs(u) < 0.01) continue;  // the kink
      ASSERT_NEAR((*derivative)(u), slope, 1e-8 * (1 + std::abs(slope))) << known.text << " at u = " << u;
    }
  }
}

TEST(Formula, DerivativeIsPartialInTheNamedVariable) {
  const FormulaPointer f = compile_formula("x^2*sin(t) + exp(x*t)", {"t", "x"});
  const std::array<double, 2> at = {0.7, 1.3};  // t, x
  const double t = at[0];
  const double x = at[1];
  EXPECT_NEAR((*differentiate(*f, "x"))(at), 2 * x * std::sin(t) + t * std::exp(x * t), 1e-14);
  EXPECT_NEAR((*differentiate(*f, "t"))(at), x * x * std::cos(t) + x * std::exp(x * t), 1e-14);
  EXPECT_THROW(differentiate(*f, "y"), Error);
}

TEST(Formula, DerivativeOfPolynomialKnowsItsCoefficients) {
  const FormulaPointer derivative = differentiate(*in_u("0.25*u^4 - u^2 + 7"), "u");
  ASSERT_TRUE(derivative->polynomial());
  EXPECT_EQ(*derivative->polynomial(), (std::vector<double>{0, -2, 0, 1}));
  EXPECT_EQ(*differentiate(*in_u("7"), "u")->polynomial(), std::vector<double>{0.0});
}

TEST(Formula, WhatHasNoDerivativeSaysSo) {
  for (const char* text : {"min(u, 1)", "max(u, u^2)", "(-2)^u"}) {
    EXPECT_THROW(differentiate(*in_u(text), "u"), Error) << text;
  }
}

TEST(Formula, PrecedenceIsThatOfMathematics) {
  EXPECT_EQ(constant("1 + 2*3"), 7);
  EXPECT_EQ(constant("2*3^2"), 18);
  EXPECT_EQ(constant("-2^2"), -4);
  EXPECT_EQ(constant("(-2)^2"), 4);
  EXPECT_EQ(constant("2^3^2"), 512);
  EXPECT_EQ(constant("2^-1"), 0.5);
  EXPECT_EQ(constant("8/4/2"), 1);
  EXPECT_EQ(constant("8 - 4 - 2"), 2);
  EXPECT_EQ(constant("3*-2"), -6);
  EXPECT_EQ(constant("--3"), 3);
  EXPECT_EQ(constant("1/256"), 1.0 / 256);
  EXPECT_EQ(constant(".5 + 1. + 1e-1"), 0.5 + 1.0 + 0.1);
  EXPECT_EQ(constant("2*pi"), 2 * pi);
  EXPECT_EQ(constant("max(2, 3) - min(2, 3)"), 1);
}

TEST(Formula, CoefficientsOfPolynomialsAreExactDecimals) {
  EXPECT_EQ(in_u("0.1*u^3*3 - 0.3*u^3 + 2*u")->polynomial(), (std::vector<double>{0, 2}));  // 0.1·3 ≠ 0.3 in double
  EXPECT_EQ(in_u("(u - 1)^3")->polynomial(), (std::vector<double>{-1, 3, -3, 1}));
  EXPECT_EQ(in_u("u^2.0 + u^(4/2)")->polynomial(), (std::vector<double>{0, 0, 2}));
  EXPECT_EQ(in_u("-u^4/4 + pi")->polynomial(), (std::vector<double>{pi, 0, 0, 0, -0.25}));
  EXPECT_EQ(in_u("sqrt(2)*u")->polynomial(), (std::vector<double>{0, std::sqrt(2.0)}));
  EXPECT_EQ(in_u("u - u")->polynomial(), std::vector<double>{0.0});
  EXPECT_EQ(in_u("3")->polynomial(), std::vector<double>{3.0});
  EXPECT_EQ(in_u("u^64")->polynomial()->size(), 65U);
}

TEST(Formula, WhatIsNoPolynomialHasNoCoefficients) {
  for (const char* text : {"sin(u)", "1/u", "u^0.5", "2^u", "abs(u)", "u^-1", "(1e300*u)^3"})
    EXPECT_FALSE(in_u(text)->polynomial()) << text;
  EXPECT_FALSE(compile_formula("t*x", {"t", "x"})->polynomial()) << "two variables";
}

TEST(Formula, StepIsZeroThenAHalfThenOne) {
  const FormulaPointer step = in_u("step(u)");
  EXPECT_EQ((*step)(-1e-300), 0);
  EXPECT_EQ((*step)(0.0), 0.5);
  EXPECT_EQ((*step)(-0.0), 0.5);
  EXPECT_EQ((*step)(1e-300), 1);
  EXPECT_TRUE(std::isnan((*step)(std::nan(""))));
}

TEST(Formula, WhatIsNotRealComesBackAsNaNOrInfinity) {
  EXPECT_TRUE(std::isnan((*in_u("sqrt(u)"))(-1.0)));
  EXPECT_TRUE(std::isnan((*in_u("log(u)"))(-1.0)));
  EXPECT_TRUE(std::isinf((*in_u("1/u"))(0.0)));
  EXPECT_TRUE(std::isnan((*in_u("min(u, 1)"))(std::nan(""))));
  EXPECT_TRUE(std::isnan((*in_u("max(1, u)"))(std::nan(""))));
}

TEST(Formula, ComplaintsPointIntoTheText) {
  EXPECT_EQ(complaint("0.5*u + 2u"),
            "formula, column 10: a multiplication sign is missing: write 2*u (in \"0.5*u + 2u\")");
  EXPECT_THAT(complaint("ü + u"), HasSubstr("column 1:"));
  EXPECT_THAT(complaint("u·ü"), HasSubstr("column 2: the character '·' has no meaning here; write *"));
  const std::string far = complaint(std::string(200, ' ') + "2u" + std::string(200, ' '));
  EXPECT_THAT(far, HasSubstr("column 202:"));
  EXPECT_LT(far.size(), 300U) << "only the surroundings are shown";
}

TEST(Formula, EachMistakeHasItsOwnSentence) {
  const std::vector<std::pair<std::string, std::string>> mistakes = {
      {"2u", "write 2*u"},
      {"2(u+1)", "write 2*("},
      {"(u)(v)", "write )*("},
      {"u v", "write u*v"},
      {"u(v)", "u is not a function; for a product write u*(…)"},
      {"u(j+1)", "u is not a function; for a product write u*(…)"},
      {"u[j+1]", "column 2: the character '[' has no meaning here; write ( )"},
      {"2 3", "two numbers"},
      {"1.2.3", "two numbers"},
      {"u**2", "written with ^"},
      {"sin u", "stands in parentheses: sin(…)"},
      {"sin()", "sin takes 1 argument, not 0"},
      {"sin(u, v)", "sin takes 1 argument, not 2"},
      {"max(u)", "max takes 2 arguments, not 1"},
      {"sinn(u)", "did you mean 'sin'?"},
      {"gamm", "unknown name 'gamm'"},
      {"np.sin(u)", "column 3: the character '.' has no meaning here; functions stand without a module: write sin"},
      {"0.1.*u", "every formula is that of one point: write *"},
      {"u > 1 ? 1 : 0", "a switch is written with step"},
      {"(u ? 1 : 0)", "a switch is written with step"},
      {"u?", "the character '?' has no meaning here (in"},
      {"1 if u else 0", "there is no 'if': a switch is written with step"},
      {"heaviside(u)", "there is no 'heaviside'; write step( )"},
      {"arctan(u)", "there is no 'arctan'; write atan( )"},
      {"pow(u, 2)", "there is no 'pow'; write a^b"},
      {"|u|", "write abs( )"},
      {"\\frac{u}{2}", "formulas are not LaTeX"},
      {"α*u", "names are in Latin letters: write alpha"},
      {"u⁴", "write ^4"},
      {"∂u", "derivatives are written u_x in an energy"},
      {"e^u", "write exp(1)"},
      {"ln(u)", "write log( )"},
      {"(u + 1", "not closed"},
      {"u + 1)", "closes nothing"},
      {"sin(u", "not closed"},
      {"u +", "ends where a value is expected"},
      {"u + * v", "'*' stands where a value is expected"},
      {"()", "')' stands where a value is expected"},
      {"", "empty"},
      {"   ", "empty"},
      {"0,5*u", "decimals are written with a point"},
      {"u = 2", "not an equation"},
      {"u²", "write ^2"},
      {"u − 1", "write -"},
      {"1/0", "divides by zero"},
      {"u/(1 - 1)", "divides by zero"},
      {"log(-1)*u", "not a finite real number"},
      {"sqrt(-2)", "not a finite real number"},
      {"9^9^9", "not a finite real number"},
      {"1e999*u", "too large or too small"},
      {"u^65", "degree 65; at most 64"},
      {"(u^8)^9", "degree 72; at most 64"},
      {"(1 + u)^65", "degree 65; at most 64"},
      {"u^40*v^40", "degree 80; at most 64"},
      {"u\x01", "with code 1"},
  };
  for (const auto& [text, sentence] : mistakes) {
    EXPECT_THAT(complaint(text), HasSubstr(sentence)) << text;
    EXPECT_THAT(complaint(text), HasSubstr("formula, column ")) << text;
  }
  EXPECT_EQ(complaint("2*u^2.0 - max(v, 0)"), "") << "the check can tell";
}

TEST(FormulaTower, PowersOfPowersAreNestedAtMostFourDeep) {
  EXPECT_NO_THROW(parse_formula("x^x^x^x^x", {"x"}));
  EXPECT_THROW(parse_formula("x^x^x^x^x^x", {"x"}), Error);
  EXPECT_THROW(parse_formula("2^(1 + x^(x^(x^(x^x))))", {"x"}), Error);
  EXPECT_NO_THROW(parse_formula("x^2 + x^3 + x^4 + x^5 + x^6 + x^7", {"x"})) << "side by side they are no tower";
}

TEST(Formula, SizeAndDepthAreBounded) {
  EXPECT_THAT(complaint(std::string(100000, '(')), HasSubstr("100000 characters is too long"));
  EXPECT_THAT(complaint(std::string(1500, '(') + "u" + std::string(1500, ')')), HasSubstr("nested more than"));
  std::string powers = "u";
  std::string sines = "u";
  for (int i = 0; i < 300; ++i) {
    powers.insert(0, "2^");
    sines.insert(0, "sin(").append(")");
  }
  EXPECT_THAT(complaint(powers), HasSubstr("exponents stand in exponents"));
  EXPECT_THAT(complaint(sines), HasSubstr("nested more than"));
  EXPECT_EQ((*in_u(std::string(3001, '-') + "u"))(2.0), -2.0) << "signs do not nest";
  std::string sum = "u";
  for (int i = 0; i < 1900; ++i) sum += "+u";
  EXPECT_EQ((*in_u(sum))(1.0), 1901.0) << "sums do not nest";
  std::string deepest = "u";  // every level keeps as many operands waiting as it can
  for (int i = 0; i < deepest_nesting / 2; ++i)
    deepest.insert(0, i < highest_tower ? "1+2*3^max(1," : "1+2*max(1,").append(")");
  EXPECT_EQ(complaint(deepest), "");
}

TEST(Formula, RandomTextIsReadOrRefusedButNeverCrashes) {
  std::mt19937_64 random(3);
  const std::vector<std::string> pieces = {"u", "v",    "2",    "0.5", "1e3", "+",   "-", "*",  "/", "^",  "(",
                                           ")", "sin(", "max(", ",",   "pi",  "sq(", " ", "**", "é", "1.", "\xFF"};
  std::uniform_int_distribution<std::size_t> piece(0, pieces.size() - 1);
  std::uniform_int_distribution<int> length(1, 12);
  int accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (int n = length(random); n > 0; --n) text += pieces[piece(random)];
    accepted += complaint(text).empty() ? 1 : 0;
  }
  EXPECT_GT(accepted, 100) << "the pieces no longer make formulas";
}

TEST(Formula, ManyThreadsMayEvaluateAndCompileAtOnce) {
  const FormulaPointer shared = in_u("sin(u)^2 + cos(u)^2");
  std::vector<double> worst(4, 0.0);
  std::vector<std::thread> threads;
  for (double& distance : worst) {
    threads.emplace_back([&] {
      for (int i = 0; i < 2000; ++i) {
        const FormulaPointer own = in_u("(u + 1)^3 - u^3");
        distance = test::worse(distance, test::worse(std::abs((*shared)(i)-1), std::abs((*own)(1.0) - 7)));
        differentiate(*own, "u");
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const double error : worst) EXPECT_LT(error, 1e-14);
}

}  // namespace TEST_FILE
}  // namespace seiche
