#include <seiche/noise/random_numbers.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

std::vector<double> numbers(const RandomRow& row, Index first, std::size_t count) {
  std::vector<double> out(count);
  normal_numbers(row, first, out);
  return out;
}

TEST(RandomNumbers, DependOnTheirPlaceAloneHoweverTheyAreDivided) {
  const RandomRow row{.seed = 7, .stream = 3, .step = 11, .part = 1};
  const std::vector<double> all = numbers(row, 0, 3000);
  for (const Index cut : {1, 2, 5, 511, 512, 513, 1025, 2999}) {
    std::vector<double> parts = numbers(row, 0, static_cast<std::size_t>(cut));
    const std::vector<double> rest = numbers(row, cut, 3000 - static_cast<std::size_t>(cut));
    parts.insert(parts.end(), rest.begin(), rest.end());
    EXPECT_EQ(parts, all) << cut;
  }
}

// The largest distance of the distribution of some numbers from that of a standard normal one, times √count.
double kolmogorov(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  double worst = 0;
  const auto count = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double below = std::erfc(-x[i] / std::sqrt(2.0)) / 2;
    worst = std::max({worst, below - static_cast<double>(i) / count, static_cast<double>(i + 1) / count - below});
  }
  return worst * std::sqrt(count);
}

TEST(RandomNumbers, AreNormalAlongARowAndAcrossRows) {
  constexpr std::size_t count = 1 << 20;
  constexpr double one_in_1e5 = 2.5;  // of Kolmogorov's distribution
  EXPECT_LT(kolmogorov(numbers({.seed = 1}, 0, count)), one_in_1e5);
  std::vector<double> of_steps, of_streams, of_seeds;
  for (std::uint64_t k = 0; k < 20000; ++k) {
    of_steps.push_back(numbers({.seed = 1, .step = k}, 5, 1)[0]);
    of_streams.push_back(numbers({.seed = 1, .stream = k}, 5, 1)[0]);
    of_seeds.push_back(numbers({.seed = k}, 5, 1)[0]);
  }
  EXPECT_LT(kolmogorov(of_steps), one_in_1e5);
  EXPECT_LT(kolmogorov(of_streams), one_in_1e5);
  EXPECT_LT(kolmogorov(of_seeds), one_in_1e5);
}

TEST(RandomNumbers, OfNeighboursAndOfDifferentRowsAreUncorrelated) {
  constexpr std::size_t count = 1 << 18;
  const auto correlation = [](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum / std::sqrt(static_cast<double>(a.size()));  // standard normal
  };
  const RandomRow row{.seed = 1};
  const std::vector<double> x = numbers(row, 0, count);
  for (const Index lag : {1, 2, 3, 4, 8, 512}) EXPECT_LT(std::abs(correlation(x, numbers(row, lag, count))), 5) << lag;
  for (const RandomRow& other : {RandomRow{.seed = 2}, RandomRow{.seed = 1, .stream = 1},
                                 RandomRow{.seed = 1, .step = 1}, RandomRow{.seed = 1, .part = 1}})
    EXPECT_LT(std::abs(correlation(x, numbers(other, 0, count))), 5);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
