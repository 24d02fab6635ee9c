// Variable steps: which are kept, taken back and counted, and where a run gives up.
#include <test/support/cases.hpp>

#include <seiche/config/custom/custom_problem.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/loop/adaptive.hpp>
#include <seiche/loop/step_controller.hpp>
#include <seiche/simulation/simulation.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <regex>

namespace seiche::test {
namespace TEST_FILE {

TEST(Adaptive, TheSolutionBetweenStepsEndsWhereTheStepDoes) {
  const Problem p = klein_gordon_case();
  for (const std::string method : {"egc2", "egc6", "seisav", "etdrk4", "crkn6"}) {
    Simulation simulation(p, {.method = method, .variable_steps = true});
    AdaptiveStepper& stepper = simulation.adaptive_stepper();
    for (int n = 0; n < 5; ++n) ASSERT_TRUE(stepper.attempt(simulation.state(), 0.25).solved());
    State between;
    stepper.interpolate(simulation.state(), simulation.state().t, between);
    EXPECT_LE((between.z - simulation.state().z).lpNorm<Eigen::Infinity>(), 1e-14) << method;
  }
}

TEST(Adaptive, TheControllerRejectsAStepWhoseErrorIsNaN) {
  StepController controller(4, 1e-6);
  EXPECT_FALSE(controller.accepts(std::nan(""), 0.1, 0));
  EXPECT_LT(controller.next(0.1), 0.1);
  EXPECT_TRUE(controller.accepts(1e-9, 0.1, 0));
  controller.reset();
  StepController fresh(4, 1e-6);
  EXPECT_EQ(controller.accepts(1e-8, 0.1, 0), fresh.accepts(1e-8, 0.1, 0));
  EXPECT_EQ(controller.next(0.1), fresh.next(0.1));
}

// Everything for a new h costs as much as many steps.
TEST(Adaptive, AStepThatNearlyFitsIsKept) {
  constexpr double tolerance = 1e-6, h = 0.125, allowed = 0.5 * tolerance * h;  // of order four
  StepController controller(4, tolerance);
  EXPECT_TRUE(controller.accepts(0.5 * allowed, h, 0));
  for (const double share : {0.3, 0.4, 0.5, 0.6}) {
    EXPECT_TRUE(controller.accepts(share * allowed, h, 0));
    EXPECT_EQ(controller.next(h), h) << share;
  }
  EXPECT_TRUE(controller.accepts(0.2 * allowed, h, 0));
  EXPECT_EQ(controller.next(h), h * std::exp2(0.25));
  EXPECT_TRUE(controller.accepts(0.9 * allowed, h, 0));
  EXPECT_LT(controller.next(h), h);
  EXPECT_FALSE(controller.accepts(2 * allowed, h, 0));
  EXPECT_LT(controller.next(h), h);
}

TEST(Adaptive, TheFirstStepKnowsTheTolerance) {
  EXPECT_LT(StepController(4, 1e-9).first_share(), StepController(4, 1e-3).first_share());
  EXPECT_LT(StepController(4, 1e-6).first_share(), StepController(8, 1e-6).first_share());
}

TEST(Adaptive, NumbersThatMakeNoSenseAreRefused) {
  Simulation simulation(duffing_case(), {.method = "egc4", .variable_steps = true});
  const auto with = [&](const AdaptiveOptions& options) {
    return integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(), options);
  };
  EXPECT_THROW(with({.tolerance = 0, .t_end = 1}), Error);
  EXPECT_THROW(with({.tolerance = std::nan(""), .t_end = 1}), Error);
  EXPECT_THROW(with({.tolerance = 1e-6, .t_end = -1}), Error);
  EXPECT_THROW(with({.tolerance = 1e-6, .t_end = 1, .first_h = -1}), Error);
  Simulation fixed(duffing_case(), {.method = "egc4"});
  EXPECT_THROW(fixed.adaptive_stepper(), Error);
}

// Klein–Gordon with α = −1 and no damping blows up at t ≈ 12.7.
TEST(Adaptive, ABlowUpEndsTheRunWithTheTimeItReached) {
  Simulation simulation(klein_gordon_case(0.0, -1.0), {.method = "egc6", .variable_steps = true});
  const RunReport report = integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                                              {.tolerance = 1e-6, .t_end = 20});
  EXPECT_EQ(report.status, RunReport::Status::failed);
  EXPECT_NEAR(report.t, 12.7, 0.1) << report.message;
  EXPECT_TRUE(simulation.state().z.allFinite());
}

// H = p²/2 − q⁴/4 is unbounded below, and q is infinite at t ≈ 0.93.
Problem beyond_the_rim() {
  return custom_problem({.H = "p^2/2 - q^4/4", .D = {{"0", "0"}, {"0", "0.05"}}, .initial = {{"q", "2"}, {"p", "0"}}});
}

TEST(Adaptive, AToleranceThatNoStepMeetsIsSaidPerUnitOfTimeAsItIsJudged) {
  Simulation simulation(beyond_the_rim(), {.method = "crkn6", .variable_steps = true});
  const RunReport report = integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                                              {.tolerance = 1e-8, .t_end = 10});
  ASSERT_EQ(report.status, RunReport::Status::failed);
  const std::regex sentence(
      "the last one, of h = (\\S+) at t = (\\S+), has an error of (\\S+), which is (\\S+) per unit of time, and tolerance = "
      "1e-08 allows (\\S+) per unit of time; a larger tolerance may do");
  std::smatch said;
  ASSERT_TRUE(std::regex_search(report.message, said, sentence)) << report.message;
  const auto number = [&](std::size_t i) { return std::stod(said[i]); };
  EXPECT_NEAR(number(2), report.t, 1e-6);
  EXPECT_NEAR(number(3) / number(1), number(4), 0.02 * number(4));
  EXPECT_GT(number(4), number(5));
  EXPECT_LE(number(5), 1e-8);
}

// An attempt that is taken back is no step of the solution; of one that stays the move is part of its error.
TEST(Adaptive, AReplacedStepIsNotCountedWhereItIsTakenBackOrItsErrorIsAccepted) {
  class TakesBack final : public AdaptiveStepper {
   public:
    void begin(State&) override {}
    StepReport step(State& state, double h) override { return attempt(state, h); }
    StepReport attempt(State&, double h) override {
      ++attempts;
      last_h_ = h;
      return {.replaced = {.count = 1, .why = "it was long", .remedy = "a smaller h"}};
    }
    int order() const override { return 4; }
    std::optional<double> error(const State&) override { return last_h_ > 0.1 ? 1.0 : 1e-12; }
    EnergyReading energy(const State&) const override { return {.H = 1.0, .modified = 1.0}; }
    bool has_modified_energy() const override { return false; }
    void keep_ledger() override {}
    void undo(State&) override {}
    void interpolate(const State&, double, State&) override {}
    void forget(State&) override {}
    void restart(State&) override {}
    int attempts = 0;

   private:
    double last_h_ = 0;
  };
  Simulation simulation(duffing_case(), {.method = "egc4", .variable_steps = true});
  TakesBack stepper;
  const RunReport report = integrate_adaptive(simulation.system(), stepper, simulation.state(),
                                              {.tolerance = 1e-6, .t_end = 1, .first_h = 0.3, .largest_h = 0.3});
  ASSERT_EQ(report.status, RunReport::Status::success) << report.message;
  EXPECT_GT(report.rejected, 0);
  EXPECT_EQ(report.replaced.count, 0) << report.message;
}

}  // namespace TEST_FILE
}  // namespace seiche::test
