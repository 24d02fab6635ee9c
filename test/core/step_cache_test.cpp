// What is computed once for each step size.
#include <seiche/core/step_cache.hpp>

#include <gtest/gtest.h>

#include <stdexcept>

namespace seiche::test {
namespace TEST_FILE {

TEST(StepCache, MakesEachOnceAndForgetsTheLeastRecentlyUsed) {
  StepCache<double> cache(2);
  int made = 0;
  const auto at = [&](double h) {
    return cache.at(h, [&] {
      ++made;
      return std::make_unique<double>(2 * h);
    });
  };
  EXPECT_EQ(at(1), 2);
  EXPECT_EQ(at(2), 4);
  EXPECT_EQ(at(1), 2);
  EXPECT_EQ(made, 2);
  EXPECT_EQ(at(3), 6);  // in the place of 2
  EXPECT_EQ(at(1), 2);
  EXPECT_EQ(made, 3);
  EXPECT_EQ(at(2), 4);
  EXPECT_EQ(made, 4);
}

TEST(StepCache, KeepsWhatItHasWhereNothingCanBeMade) {
  StepCache<double> cache(1);
  cache.at(1, [] { return std::make_unique<double>(5); });
  const auto none = []() -> std::unique_ptr<double> { throw std::runtime_error("no propagator"); };
  EXPECT_THROW(cache.at(2, none), std::runtime_error);
  EXPECT_EQ(cache.at(1, none), 5);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
