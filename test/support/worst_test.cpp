// What the other tests measure with.
#include <test/support/worst.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace seiche::test {
namespace TEST_FILE {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Worst, TheWorstOfSeveralNumbersIsNaNWhereAnyIsNaN) {
  EXPECT_TRUE(std::isnan(worse(1, nan)));
  EXPECT_TRUE(std::isnan(worse(nan, 1)));
  EXPECT_EQ(worse(1, 2), 2);
  EXPECT_EQ(worse(2, 1), 2);
  for (Eigen::Index n : {1, 3, 40}) {
    for (Eigen::Index i = 0; i < n; ++i) {
      Eigen::VectorXd a = Eigen::VectorXd::Constant(n, -2);
      EXPECT_EQ(largest(a), 2);
      a[i] = nan;
      EXPECT_TRUE(std::isnan(largest(a))) << n << " " << i;
    }
  }
  EXPECT_EQ(largest(Eigen::VectorXd()), 0);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
