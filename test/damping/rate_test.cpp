// Damping coefficients γ(t) and their integrals.
#include <seiche/core/base/error.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/formula/formula_compiler.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace seiche {
namespace TEST_FILE {

RatePointer rate(const std::string& text) { return formula_rate(compile_formula(text, {"t"})); }

struct ClosedForm {
  std::string text;
  std::function<double(double, double)> integral;  // over [t, t + h], free of cancellation
};

std::vector<ClosedForm> closed_forms() {
  return {
      {"0.3 + 0*t", [](double, double h) { return 0.3 * h; }},
      {"2*t", [](double t, double h) { return h * (2 * t + h); }},
      {"(t - 1)^2 + 0.1", [](double t, double h) { return h * ((t - 1) * (t - 1 + h) + h * h / 3 + 0.1); }},
      {"0.4 + 0.2*sin(t)", [](double t, double h) { return 0.4 * h + 0.4 * std::sin(t + h / 2) * std::sin(h / 2); }},
      {"exp(-t)", [](double t, double h) { return -std::exp(-t) * std::expm1(-h); }},
      {"1/(1 + t)", [](double t, double h) { return std::log1p(h / (1 + t)); }},
      {"cos(40*t)^2", [](double t, double h) { return h / 2 + std::cos(80 * t + 40 * h) * std::sin(40 * h) / 80; }},
  };
}

TEST(Rate, IntegralMeetsTheClosedForm) {
  for (const ClosedForm& form : closed_forms()) {
    const RatePointer gamma = rate(form.text);
    for (const double t : {0.0, 0.37, 3.0, 50.0}) {
      for (const double h : {1e-6, 1.0 / 256, 0.5, 3.0}) {
        const double expected = form.integral(t, h);
        const double phase = 1 + t;  // cos(40 t) is only as exact as its argument
        EXPECT_NEAR(gamma->integral(t, h), expected, 1e-14 * phase * std::abs(expected))
            << form.text << " over [" << t << ", " << t << " + " << h << "]";
      }
    }
  }
}

TEST(Rate, IntegralOfPolynomialsIsExactToTheHighestDegree) {
  for (const int degree : {1, 5, 13, 14, 40, 59, 60, 64}) {
    const RatePointer gamma = rate("t^" + std::to_string(degree));
    EXPECT_NEAR(gamma->integral(0.0, 1.0) * (degree + 1), 1.0, 1e-14) << "degree " << degree;
    const double at_two = std::exp2(degree + 1) / (degree + 1);
    EXPECT_NEAR(gamma->integral(0.0, 2.0) / at_two, 1.0, 1e-14) << "degree " << degree;
  }
}

TEST(Rate, IntegralCrossesKinks) {
  EXPECT_NEAR(rate("abs(t - 1)")->integral(0.0, 2.3), 0.5 + 1.3 * 1.3 / 2, 1e-14);
  EXPECT_NEAR(rate("max(0, t - 1.1)")->integral(1.0, 1.0), 0.9 * 0.9 / 2, 1e-14);
  EXPECT_NEAR(rate("sqrt(t)")->integral(0.0, 1.0), 2.0 / 3, 1e-12);
}

TEST(Rate, IntegralAddsUpOverSteps) {
  const RatePointer gamma = rate("0.1 + 0.05*sin(t)");
  double sum = 0.0;
  for (int n = 0; n < 3200; ++n) sum += gamma->integral(n / 64.0, 1.0 / 64);
  EXPECT_NEAR(sum, 5 + 0.05 * (1 - std::cos(50.0)), 1e-12);
}

TEST(Rate, NonnegativeRateHasNonnegativeIntegral) {
  // An antiderivative of (t − 1)⁴ written out would return negative numbers here.
  for (const char* text : {"(t - 1)^4", "(t - 1)^64", "sin(t)^2", "abs(sin(50*t))", "exp(-t)*(1 + cos(t))"}) {
    const RatePointer gamma = rate(text);
    for (int n = 0; n < 400; ++n) ASSERT_GE(gamma->integral(n / 200.0, 1.0 / 200), 0.0) << text << ", step " << n;
  }
}

TEST(Rate, ConstantIsExact) {
  const RatePointer gamma = constant_rate(0.1);
  EXPECT_TRUE(gamma->is_constant());
  EXPECT_EQ(gamma->value(7.0), 0.1);
  EXPECT_EQ(gamma->integral(1e9, 0.25), 0.1 * 0.25);
  EXPECT_EQ(gamma->text(), "0.1");
  EXPECT_LT(gamma->first_negative_time(100.0), 0.0);
  EXPECT_EQ(constant_rate(-0.1)->first_negative_time(100.0), 0.0);
  EXPECT_THROW(constant_rate(std::nan("")), Error);
  EXPECT_THROW(constant_rate(INFINITY), Error);
}

TEST(Rate, FormulaKnowsWhetherItIsConstant) {
  EXPECT_TRUE(rate("0.1 + t - t")->is_constant());
  EXPECT_EQ(rate("0.1 + t - t")->value(3.0), 0.1) << "exactly, though 0.1 + 3 − 3 is not 0.1 in double";
  EXPECT_EQ(rate("0.1 + t - t")->integral(3.0, 0.5), 0.05);
  EXPECT_FALSE(rate("0.1 + t")->is_constant());
  EXPECT_FALSE(rate("sin(t)")->is_constant());
  EXPECT_EQ(rate("0.1*sin(t)")->text(), "0.1*sin(t)");
}

TEST(Rate, NegativeTimesAreFound) {
  EXPECT_NEAR(rate("sin(t)")->first_negative_time(50.0), std::acos(-1.0), 50.0 / 4096);
  EXPECT_EQ(rate("t - 1")->first_negative_time(10.0), 0.0);
  EXPECT_LT(rate("0.1 + 0.05*sin(t)")->first_negative_time(50.0), 0.0);
  EXPECT_LT(rate("2 - t")->first_negative_time(1.9), 0.0) << "negative only after the end";
  EXPECT_GT(rate("2 - t")->first_negative_time(2.1), 2.0);
}

TEST(Rate, WhatIsNotFiniteIsLeftForTheCallerToSee) {
  EXPECT_TRUE(std::isinf(rate("1/t")->value(0.0)));
  EXPECT_TRUE(std::isnan(rate("log(t - 1)")->integral(0.0, 2.0)));
}

FieldRatePointer field_rate(const std::string& text, bool constant_in_time, const Grid& grid) {
  return formula_space_rate(compile_formula(text, {"t", "x", "y"}), 2, constant_in_time)->on(grid);
}

const Grid plane{.axes = {{3, 3.0, Boundary::periodic}, {2, 1.0, Boundary::neumann}}};

TEST(FieldRate, IntegralsMeetTheClosedFormAtEveryPoint) {
  const FieldRatePointer steady = field_rate("x + 10*y", true, plane);
  const FieldRatePointer varying = field_rate("(x + 10*y)*(1 + sin(t))", false, plane);
  EXPECT_TRUE(steady->is_constant());
  EXPECT_FALSE(varying->is_constant());
  std::vector<double> a(6);
  std::vector<double> b(6);
  std::vector<double> gamma(6);
  for (const double t : {0.0, 0.37, 3.0}) {
    for (const double h : {1e-6, 1.0 / 64, 3.0}) {
      steady->integrals(t, h, a);
      varying->integrals(t, h, b);
      varying->values(t, gamma);
      for (Index j = 0; j < 6; ++j) {
        const double shape = plane.coordinate(j, 0) + 10 * plane.coordinate(j, 1);
        const auto i = static_cast<std::size_t>(j);
        EXPECT_EQ(a[i], h * shape);
        const double expected = shape * (h + 2 * std::sin(t + h / 2) * std::sin(h / 2));
        EXPECT_NEAR(b[i], expected, 1e-14 * expected);
        EXPECT_NEAR(gamma[i], shape * (1 + std::sin(t)), 1e-14 * shape);
      }
    }
  }
}

TEST(FieldRate, NonnegativeRatesHaveNonnegativeIntegralsAndKinksAreCrossed) {
  const FieldRatePointer rate = field_rate("max(0, t - 0.1*x)", false, plane);  // x = 1, 2, 3
  std::vector<double> integral(6);
  rate->integrals(0.0, 1.0, integral);
  for (Index j = 0; j < 6; ++j)
    EXPECT_NEAR(integral[static_cast<std::size_t>(j)], std::pow(1 - 0.1 * plane.coordinate(j, 0), 2) / 2, 1e-13);
  const FieldRatePointer even = field_rate("(t - x)^4", false, plane);
  for (int n = 0; n < 300; ++n) {
    even->integrals(n / 100.0, 1.0 / 100, integral);
    for (const double value : integral) ASSERT_GE(value, 0.0);
  }
}

TEST(FieldRate, NegativeValuesAreFoundAnywhere) {
  EXPECT_EQ(field_rate("2.5 - x", true, plane)->first_negative_time(10), 0);
  EXPECT_LT(field_rate("3.5 - x", true, plane)->first_negative_time(10), 0);
  const FieldRatePointer later = field_rate("4 - x - t", false, plane);
  EXPECT_LT(later->negative_seen(), 0);
  EXPECT_NEAR(later->first_negative_time(10), 1, 0.02);
  EXPECT_GE(later->negative_seen(), 1);
}

TEST(FieldRate, AGridWithTooFewAxesIsRefused) {
  try {
    field_rate("x*y", true, {.axes = {{8, 1.0, Boundary::periodic}}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "the rate x*y names y, but the grid has 1 axis");
  }
}

}  // namespace TEST_FILE
}  // namespace seiche
