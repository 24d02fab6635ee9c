// What stands beside the axes of pictures: numbers that can be read and told apart.
#include <seiche/figure/plot/axis.hpp>
#include <seiche/figure/plot/linear_ticks.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace seiche {
namespace TEST_FILE {

using testing::HasSubstr;
using testing::StartsWith;

TEST(Axis, OrdinaryNumbersAreLeftToGnuplot) {
  for (const auto& [low, high] : {std::array{0.0, 1.0}, {-3.0, 9999.0}, {0.002, 0.009}, {990.0, 1010.0}}) {
    const LinearTicks ticks = linear_ticks(low, high);
    EXPECT_EQ(ticks.ticks, "autofreq") << low << " " << high;
    EXPECT_EQ(with_unit("'u'", ticks), "'u'");
  }
}

TEST(Axis, PowersOfTenOfVeryLargeAndSmallNumbersStandInTheLabel) {
  const LinearTicks small = linear_ticks(0, 5e-10);
  EXPECT_THAT(small.ticks, StartsWith("('0' 0, '1' 1"));
  EXPECT_THAT(small.ticks, HasSubstr("'5' 5"));
  EXPECT_EQ(with_unit("'u'", small), "('' . 'u' . ' / 10^{−10}')");
  EXPECT_EQ(linear_ticks(0, 1e5).power, " / 10^{5}");
  EXPECT_THAT(linear_ticks(-2e5, 2e5).ticks, HasSubstr("'−1' -100000"));
}

TEST(Axis, ThePartThatAllNumbersShareStandsInTheLabel) {
  EXPECT_EQ(with_unit("'u'", linear_ticks(999.99, 1000.01)), "('(' . 'u' . ' − 1000) / 10^{−2}')");
  EXPECT_EQ(with_unit("'u'", linear_ticks(-1000.02, -1000.0)), "('(' . 'u' . ' + 1000) / 10^{−2}')");
  EXPECT_EQ(linear_ticks(299792.1, 299795.3).offset, " − 299794");
  EXPECT_EQ(linear_ticks(1e12, 1e12 + 1).offset, " − 10^{12}");
}

TEST(Axis, AnAxisOfNothingButRoundOffHasAnExtent) {
  const std::array values = {0.5, std::nextafter(0.5, 1.0), std::nextafter(0.5, 0.0)};
  const Axis axis = fitted_axis(false, values);
  EXPECT_GT(axis.high - axis.low, 1);
}

TEST(Axis, AnAxisFromZeroEndsAtARoundNumberNearby) {
  EXPECT_EQ(axis_from_zero(19.84).high, 20);
  EXPECT_EQ(axis_from_zero(49.9).high, 50);
  EXPECT_EQ(axis_from_zero(50).high, 50);
  EXPECT_EQ(axis_from_zero(43).high, 43);
}

}  // namespace TEST_FILE
}  // namespace seiche
