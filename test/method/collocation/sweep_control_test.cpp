// How many sweeps a step of collocation makes.
#include <seiche/method/collocation/sweep_control.hpp>
#include <seiche/simulation/simulation.hpp>

#include <test/support/cases.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace seiche::test {
namespace TEST_FILE {

struct Outcome {
  int sweeps = 0, questions = 0;
};

// Changes 1, rate, rate², …
Outcome sweeps(SweepControl control, double rate, double error) {
  Outcome outcome;
  double change = 1;
  const auto asked = [&] {
    ++outcome.questions;
    return error;
  };
  do {
    change *= ++outcome.sweeps == 1 ? 1 : rate;
  } while (control.wants_another(change, asked));
  return outcome;
}

TEST(SweepControl, MakesTwiceTheStagesWithoutAGuessAndTheStagesWhereNoneMayBeSaved) {
  for (const int stages : {1, 2, 3, 4}) {
    EXPECT_EQ(sweeps({stages, false, true}, 1e-3, 1.0).sweeps, 2 * stages);
    EXPECT_EQ(sweeps({stages, false, false}, 1e-3, 1.0).sweeps, 2 * stages);
    EXPECT_EQ(sweeps({stages, true, false}, 1e-3, 1.0).sweeps, stages);
    EXPECT_EQ(sweeps({stages, true, false}, 1e-3, 1.0).questions, 0);
  }
}

TEST(SweepControl, StopsWhereWhatIsLeftIsSmallBesideTheError) {
  // k sweeps leave rateᵏ
  EXPECT_EQ(sweeps({4, true, true}, 1e-2, 1e-3).sweeps, 2);
  EXPECT_EQ(sweeps({4, true, true}, 1e-2, 1e-5).sweeps, 3);
  EXPECT_EQ(sweeps({4, true, true}, 1e-2, 1e-9).sweeps, 4);
  EXPECT_EQ(sweeps({3, true, true}, 0.1, 1e-9).sweeps, 3);
  EXPECT_EQ(sweeps({3, true, true}, 0.0, 0.0).sweeps, 2) << "nothing changes any more";
}

TEST(SweepControl, TakesNoFurtherSweepsWhereSweepsDoNotConverge) {
  for (const double rate : {0.5, 1.0, 3.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(sweeps({4, true, true}, rate, 1e9).sweeps, 4) << rate;
    EXPECT_EQ(sweeps({2, true, true}, rate, 1e9).sweeps, 2) << rate;
  }
}

TEST(SweepControl, LeavesOutSweepsWhereTheNonlinearityIsWeak) {
  const Problem problem = klein_gordon_case(0.1, 1.0);
  constexpr int steps = 100;
  for (const std::string backend : {"dense", "modal"}) {
    Simulation simulation(problem, {.method = "egc8", .backend = backend});
    simulation.restart();
    const auto before = simulation.system().potential->counts().gradients;
    for (int n = 0; n < steps; ++n) ASSERT_TRUE(simulation.step(0.125).solved());
    const auto gradients = simulation.system().potential->counts().gradients - before;
    EXPECT_LT(gradients, 13 * steps) << backend << ": four sweeps at four nodes are 16";
    EXPECT_GE(gradients, 8 * steps) << backend << ": two are made at least";
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
