// What round-off of a tenth of ε a step adds up to in a long run.
#include <seiche/config/custom/custom_problem.hpp>
#include <seiche/simulation/solve.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace TEST_FILE {

// The equation of each step is solved to a few ε, with an error whose sign stays: 6e-12 in 10⁶ steps, were it not made
// up for.
TEST(DriftSlow, MultiplierMethodsDoNotDriftInAMillionStepsOfAFreePendulum) {
  const Problem pendulum = custom_problem({.H = "p^2/2 - cos(q)", .initial = {{"q", "1"}, {"p", "0.5"}}});
  for (const char* method : {"seilm", "seidm"}) {
    const Solution s = solve(pendulum, {.method = method, .h = 0.1, .t_end = 1e5, .record_every = 1000});
    ASSERT_TRUE(s.success()) << s.report.message;
    ASSERT_EQ(s.H.size(), 1001U);
    const auto [least, most] = std::minmax_element(s.H.begin(), s.H.end());
    EXPECT_LE(*most - *least, 1e-13) << method;
  }
}

}  // namespace TEST_FILE
}  // namespace seiche
