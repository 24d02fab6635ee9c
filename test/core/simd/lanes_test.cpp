// Eight lanes in registers of any width do the same.
#include <gtest/gtest.h>
#include <seiche/core/simd/add_scaled.hpp>
#include <seiche/core/simd/products.hpp>
#include <seiche/core/simd/with_lanes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

using Eight = std::array<double, lane_count>;

constexpr Eight a = {1, -2, 3, -4, 5, -6, 7, -8};
constexpr Eight b = {0.5, 0.25, 2, 4, -0.5, -0.25, -2, -4};

template <class V>
Eight numbers(const V& x) {
  Eight out{};
  store<V>(out.data(), x);
  return out;
}

template <class Of>
Eight each(const Of& of) {
  Eight out{};
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = of(i);
  return out;
}

template <class V>
class LanesOf : public testing::Test {};

// The sign of a zero is lost to ==, and no result here is one.
using Widths = testing::Types<Lanes, LanesInHalves, LanesInQuarters>;
TYPED_TEST_SUITE(LanesOf, Widths, );

TYPED_TEST(LanesOf, ArithmeticActsOnEachNumber) {
  const auto x = load<TypeParam>(a.data()), y = load<TypeParam>(b.data());
  EXPECT_EQ(numbers<TypeParam>(x + y), each([](std::size_t i) { return a[i] + b[i]; }));
  EXPECT_EQ(numbers<TypeParam>(x - y), each([](std::size_t i) { return a[i] - b[i]; }));
  EXPECT_EQ(numbers<TypeParam>(x * y), each([](std::size_t i) { return a[i] * b[i]; }));
  EXPECT_EQ(numbers<TypeParam>(x / y), each([](std::size_t i) { return a[i] / b[i]; }));
  EXPECT_EQ(numbers<TypeParam>(3 * x + 0.125), each([](std::size_t i) { return 3 * a[i] + 0.125; }));
  EXPECT_EQ(numbers<TypeParam>(2 / y), each([](std::size_t i) { return 2 / b[i]; }));
  TypeParam z = x;
  z += y;
  EXPECT_EQ(numbers<TypeParam>(z), each([](std::size_t i) { return a[i] + b[i]; }));
}

TYPED_TEST(LanesOf, PairsAreTurnedSpreadAndNegated) {
  const auto x = load<TypeParam>(a.data());
  EXPECT_EQ(numbers<TypeParam>(with_pairs_turned(x)), each([](std::size_t i) { return a[i ^ 1U]; }));
  EXPECT_EQ(numbers<TypeParam>(of_pairs<0>(x)), each([](std::size_t i) { return a[i / 2 * 2]; }));
  EXPECT_EQ(numbers<TypeParam>(of_pairs<1>(x)), each([](std::size_t i) { return a[i / 2 * 2 + 1]; }));
  EXPECT_EQ(numbers<TypeParam>(load_twice<TypeParam>(a.data())), each([](std::size_t i) { return a[i / 2]; }));
  EXPECT_EQ(numbers<TypeParam>(with_first_negated(x)), each([](std::size_t i) { return i % 2 == 0 ? -a[i] : a[i]; }));
}

TYPED_TEST(LanesOf, NumbersAreShiftedFromOneEightIntoTheNext) {
  const auto x = load<TypeParam>(a.data()), y = load<TypeParam>(b.data());
  EXPECT_EQ(numbers<TypeParam>(shifted(x, y)), each([](std::size_t i) { return i == 0 ? a[7] : b[i - 1]; }));
  EXPECT_EQ(last_of(x), a[7]);
}

TYPED_TEST(LanesOf, HalvesJoinToTheWhole) {
  const auto x = load<TypeParam>(a.data());
  const auto low = low_half(x), high = high_half(x);
  EXPECT_EQ(numbers<TypeParam>(joined<TypeParam>(low, high)), a);
  EXPECT_EQ(numbers<TypeParam>(joined<TypeParam>(high, low)), each([](std::size_t i) { return a[(i + 4) % 8]; }));
}

// To the bit, since sums over a grid must not depend on the processor more than its products do.
TYPED_TEST(LanesOf, SumsAreTakenInOneOrder) {
  const Eight rough = each([](std::size_t i) { return std::sin(1.0 + static_cast<double>(i)) * std::pow(10.0, i); });
  const double expected =
      ((rough[0] + rough[4]) + (rough[2] + rough[6])) + ((rough[1] + rough[5]) + (rough[3] + rough[7]));
  EXPECT_EQ(sum(load<TypeParam>(rough.data())), expected);
}

// Every number once, by as few bodies as there are: 8, 8, 4, 2, 1 of 23.
TYPED_TEST(LanesOf, LoopsVisitEveryNumberOnce) {
  std::vector<double> x;
  for (std::ptrdiff_t n = 0; n <= 26; ++n) {
    std::vector<int> visits(static_cast<std::size_t>(n));
    int bodies = 0;
    for_lanes<TypeParam>(0, n, [&]<class X>(std::ptrdiff_t j, const X&) {
      ++bodies;
      const auto width = static_cast<std::ptrdiff_t>(sizeof(X) / sizeof(double));
      for (std::ptrdiff_t i = j; i < j + width; ++i) ++visits[static_cast<std::size_t>(i)];
    });
    EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), n);
    EXPECT_EQ(bodies, n / 8 + n % 8 / 4 + n % 4 / 2 + n % 2);
    double sum_of_all = 0;
    for (const double number : x) sum_of_all += number;
    const double sum_of_lanes =
        sum_lanes<TypeParam>(0, n, [&]<class X>(std::ptrdiff_t j, const X&) { return load<X>(x.data() + j); });
    EXPECT_EQ(sum_of_lanes, sum_of_all) << n;
    x.push_back(static_cast<double>(n * n) - 40);
  }
}

TEST(AddScaled, IsThatOfEveryNumberAlsoInPlace) {
  for (Index n = 0; n <= 26; ++n) {
    Vector x = Vector::LinSpaced(n, 1, 2), y = Vector::LinSpaced(n, -3, 5);
    const Vector expected = x + 0.5 * y;
    Vector out(n);
    add_scaled(x.data(), 0.5, y.data(), n, out.data());
    EXPECT_EQ(out, expected);
    add_scaled(x.data(), 0.5, y.data(), n, y.data());
    EXPECT_EQ(y, expected);
    scale(x.data(), -3, n, y.data());
    EXPECT_EQ(y, -3 * x);
    scale(x.data(), -3, n, x.data());
    EXPECT_EQ(x, y);
  }
}

TEST(Products, AreThoseOfEveryLengthAndKnowTheSizesOfTheirTerms) {
  for (Index n = 0; n <= 50; ++n) {
    const Vector x = Vector::LinSpaced(n, -1, 2), y = Vector::LinSpaced(n, -3, 5.5);
    const double size = x.cwiseAbs().dot(y.cwiseAbs());
    EXPECT_NEAR(dot(x.data(), y.data(), n), x.dot(y), 10 * epsilon * size) << n;
    EXPECT_NEAR(squared_norm(x.data(), n), x.squaredNorm(), 10 * epsilon * x.squaredNorm()) << n;
    const ValueAndMagnitude both = dot_and_magnitude(x.data(), y.data(), n);
    EXPECT_NEAR(both.value, x.dot(y), 10 * epsilon * size) << n;
    EXPECT_NEAR(both.magnitude, size, 10 * epsilon * size) << n;
    for (Index j = 0; j < n; ++j) {
      Vector broken = x;
      for (const double value : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        broken[j] = value;
        EXPECT_FALSE(std::isfinite(dot(broken.data(), y.data(), n)));
        EXPECT_FALSE(std::isfinite(squared_norm(broken.data(), n)));
        EXPECT_FALSE(std::isfinite(dot_and_magnitude(broken.data(), y.data(), n).value));
        EXPECT_FALSE(std::isfinite(dot_and_magnitude(broken.data(), y.data(), n).magnitude));
      }
    }
  }
}

TEST(WithLanes, ChoosesTheWidestRegistersAndHandsBackWhatTheBodyReturns) {
  const double total = with_lanes([]<class V>() __attribute__((always_inline)) { return sum(load<V>(b.data())); });
  EXPECT_EQ(total, 0);
  const int parts = with_lanes([]<class V>() __attribute__((always_inline)) {
    return is_in_parts<V> ? sizeof(V{}) == sizeof(LanesInHalves) && !std::is_same_v<V, LanesInQuarters> ? 2 : 4 : 1;
  });
  EXPECT_EQ(parts, 512 / register_bits);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
