// Elementary functions by vectors are right to 1 ulp, whatever the processor's vectors, wherever a number stands.
#include <gtest/gtest.h>
#include <seiche/core/simd/vector_function_sets.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

using One = VectorFunctions::One VectorFunctions::*;

struct Row {
  std::string name;
  One f;
  std::function<long double(long double)> exact;
  double least, most;  // where it is looked at
};

const std::vector<Row>& rows() {
  constexpr double large = 700, far = 1e15;
  using L = long double;
  static const std::vector<Row> all = {
      {"sin", &VectorFunctions::sin, [](L x) { return std::sin(x); }, -far, far},
      {"cos", &VectorFunctions::cos, [](L x) { return std::cos(x); }, -far, far},
      {"tan", &VectorFunctions::tan, [](L x) { return std::tan(x); }, -far, far},
      {"asin", &VectorFunctions::asin, [](L x) { return std::asin(x); }, -1, 1},
      {"acos", &VectorFunctions::acos, [](L x) { return std::acos(x); }, -1, 1},
      {"atan", &VectorFunctions::atan, [](L x) { return std::atan(x); }, -far, far},
      {"sinh", &VectorFunctions::sinh, [](L x) { return std::sinh(x); }, -large, large},
      {"cosh", &VectorFunctions::cosh, [](L x) { return std::cosh(x); }, -large, large},
      {"tanh", &VectorFunctions::tanh, [](L x) { return std::tanh(x); }, -large, large},
      {"asinh", &VectorFunctions::asinh, [](L x) { return std::asinh(x); }, -far, far},
      {"acosh", &VectorFunctions::acosh, [](L x) { return std::acosh(x); }, 1, far},
      {"atanh", &VectorFunctions::atanh, [](L x) { return std::atanh(x); }, -1, 1},
      {"exp", &VectorFunctions::exp, [](L x) { return std::exp(x); }, -large, large},
      {"expm1", &VectorFunctions::expm1, [](L x) { return std::expm1(x); }, -large, large},
      {"log", &VectorFunctions::log, [](L x) { return std::log(x); }, 0, far},
      {"log1p", &VectorFunctions::log1p, [](L x) { return std::log1p(x); }, -1, far},
      {"sqrt", &VectorFunctions::sqrt, [](L x) { return std::sqrt(x); }, 0, far},
  };
  return all;
}

// Of all sizes between the bounds, and near 0 and the ends.
std::vector<double> arguments(double least, double most) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> evenly(0, 1);
  std::vector<double> all = {least, most, 0.5 * (least + most), std::min(most, 1.0)};
  for (int i = 0; i < 20000; ++i) {
    const double share = evenly(random);
    const double size = std::exp2(80 * share - 60);  // 1e-18 … 1e6
    for (const double x : {least + share * (most - least), size, -size, least + size, most - size, 1 + size, 1 - size})
      if (x >= least && x <= most) all.push_back(x);
  }
  return all;
}

std::vector<double> shuffled(std::vector<double> x) {
  std::shuffle(x.begin(), x.end(), std::mt19937_64(7));
  return x;
}

double ulp(double x) {
  const double size = std::max(std::abs(x), std::numeric_limits<double>::min());
  return std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
}

double error_in_ulp(double found, long double exact) {
  if (found == static_cast<double>(exact)) return 0;  // infinite ones, too
  return static_cast<double>(std::abs(static_cast<long double>(found) - exact)) / ulp(static_cast<double>(exact));
}

TEST(VectorFunctions, AreRightToOneUnitInTheLastPlace) {
  const std::vector<VectorFunctions> all = all_vector_functions();
  for (std::size_t set = 0; set < all.size(); ++set) {
    const VectorFunctions& functions = all[set];
    const double most = set + 1 < all.size() ? 1.001 : 2;  // the last are libm's
    for (const Row& row : rows()) {
      const std::vector<double> x = arguments(row.least, row.most);
      std::vector<double> y(x.size());
      (functions.*row.f)(x.data(), y.data(), x.size());
      double worst = 0, at = 0;
      for (std::size_t i = 0; i < x.size(); ++i)
        if (const double error = error_in_ulp(y[i], row.exact(x[i])); !(error <= worst)) {
          worst = std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
          at = x[i];
        }
      EXPECT_LE(worst, most) << row.name << " of " << at << ", set " << set;
    }
  }
}

TEST(VectorFunctions, GiveSineAndCosineAtOnce) {
  const std::vector<double> x = arguments(-1e6, 1e6);
  for (const VectorFunctions& functions : all_vector_functions()) {
    std::vector<double> s = x, c(x.size());
    functions.sincos(s.data(), s.data(), c.data(), x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      ASSERT_LE(error_in_ulp(s[i], std::sin(static_cast<long double>(x[i]))), 1.0) << x[i];
      ASSERT_LE(error_in_ulp(c[i], std::cos(static_cast<long double>(x[i]))), 1.0) << x[i];
    }
  }
}

TEST(VectorFunctions, RaiseToPowers) {
  const std::vector<double> bases = arguments(0, 1e3);
  std::vector<double> exponents(bases.size()), y(bases.size());
  for (std::size_t i = 0; i < bases.size(); ++i) exponents[i] = static_cast<double>(i % 81) / 8 - 5;
  for (const VectorFunctions& functions : all_vector_functions()) {
    functions.pow(bases.data(), exponents.data(), y.data(), y.size());
    for (std::size_t i = 0; i < y.size(); ++i)
      ASSERT_LE(error_in_ulp(y[i], std::pow(static_cast<long double>(bases[i]), exponents[i])), 1.0)
          << bases[i] << " to " << exponents[i];
  }
}

// Of these two, as long as angles are no longer than 10⁶. The longest angle of a register, of eight numbers or of four,
// decides how all of them are reduced; so short ones stand beside long ones here, in every mixture.
TEST(VectorFunctions, HaveTheSameBitsByAvx512AndByAvx2) {
  const std::vector<VectorFunctions> all = all_vector_functions();
  const auto is = [](const char* name) {
    return [name](const VectorFunctions& f) { return f.instructions == std::string(name); };
  };
  const auto wide = std::find_if(all.begin(), all.end(), is("avx512f")),
             narrow = std::find_if(all.begin(), all.end(), is("avx2"));
  if (wide == all.end() || narrow == all.end()) GTEST_SKIP() << "this processor does not have both";
  for (const Row& row : rows()) {
    constexpr double far = 1e6;
    const std::vector<double> x = shuffled(arguments(std::max(row.least, -far), std::min(row.most, far)));
    std::vector<double> a(x.size()), b(x.size());
    ((*wide).*row.f)(x.data(), a.data(), x.size());
    ((*narrow).*row.f)(x.data(), b.data(), x.size());
    ASSERT_EQ(std::memcmp(a.data(), b.data(), x.size() * sizeof(double)), 0) << row.name;
  }
  const std::vector<double> x = shuffled(arguments(0, 1e3));
  std::vector<double> exponents(x.size()), a(x.size()), b(x.size()), c(x.size()), d(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) exponents[i] = static_cast<double>(i % 81) / 8 - 5;
  wide->pow(x.data(), exponents.data(), a.data(), x.size());
  narrow->pow(x.data(), exponents.data(), b.data(), x.size());
  EXPECT_EQ(a, b);
  wide->sincos(x.data(), a.data(), b.data(), x.size());
  narrow->sincos(x.data(), c.data(), d.data(), x.size());
  EXPECT_EQ(a, c);
  EXPECT_EQ(b, d);
}

// Blocks end anywhere, and what stands beside a number must not change it: runs would depend on how they are cut.
TEST(VectorFunctions, DependOnTheNumberAloneAndNotOnItsPlace) {
  std::vector<double> x(40);
  for (const VectorFunctions& functions : all_vector_functions()) {
    for (const Row& row : rows()) {
      const double most = std::min(row.most, 14.9), least = std::max(row.least, -14.9);
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = least + (most - least) * static_cast<double>(i) / 39;
      for (std::size_t n = 1; n <= x.size(); ++n) {
        std::vector<double> y(n), alone(1);
        for (std::size_t i = 0; i < n; ++i) y[i] = x[i];
        const double last = y.back();
        (functions.*row.f)(y.data(), y.data(), n);
        (functions.*row.f)(&last, alone.data(), 1);
        ASSERT_TRUE(y.back() == alone.front()) << row.name << " of " << last << ", the last of " << n;
      }
    }
  }
}

TEST(VectorFunctions, KeepNaNAndInfinity) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const std::array<double, 5> x = {std::nan(""), inf, -inf, 0.0, -0.0};
  for (const VectorFunctions& functions : all_vector_functions()) {
    for (const Row& row : rows()) {
      std::array<double, 5> y{};
      (functions.*row.f)(x.data(), y.data(), x.size());
      for (std::size_t i = 0; i < x.size(); ++i) {
        const auto expected = static_cast<double>(row.exact(x[i]));
        EXPECT_EQ(std::isnan(y[i]), std::isnan(expected)) << row.name << " of " << x[i];
        if (std::isnan(expected)) continue;
        EXPECT_LE(error_in_ulp(y[i], expected), 1.0) << row.name << " of " << x[i];
      }
    }
    const std::array<double, 7> base = {std::nan(""), -2, -2, -2, 1e300, 0, inf};
    const std::array<double, 7> exponent = {2, 3, 4, 0.5, 2, 0, -1};
    std::array<double, 7> power{};
    functions.pow(base.data(), exponent.data(), power.data(), power.size());
    EXPECT_TRUE(std::isnan(power[0]) && std::isnan(power[3]));
    EXPECT_EQ(power[1], -8);
    EXPECT_EQ(power[2], 16);
    EXPECT_EQ(power[4], inf);
    EXPECT_EQ(power[5], 1);
    EXPECT_EQ(power[6], 0);
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
