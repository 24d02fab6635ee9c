// What goes wrong in a step, and what is said or done then: no outcome is silent, and no state is lost.
#include <test/support/cases.hpp>
#include <test/support/written_problem.hpp>

#include <seiche/damping/rates.hpp>
#include <seiche/loop/adaptive.hpp>
#include <seiche/loop/integrate.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/oscillator.hpp>
#include <seiche/simulation/end_of_potential.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/simulation/solve.hpp>
#include <seiche/study/reference.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace seiche::test {
namespace TEST_FILE {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

const std::vector<std::string> collocation = {"egc2", "egc4", "egc6", "egc8"};

TEST(FailureMode, SweepsThatDivergeLeaveAStepThatKeepsTheLawAndIsCounted) {
  Problem problem = duffing_case();
  problem.initial *= 100;  // a frequency of some hundred
  for (const std::string& method : collocation) {
    Simulation simulation(problem, {.method = method});
    double H = simulation.energy().H;
    int fallbacks = 0;
    for (int n = 0; n < 40; ++n) {
      const StepReport report = simulation.step(1.0);
      ASSERT_TRUE(report.solved()) << method << ": " << report.message;
      fallbacks += report.fallbacks;
      const EnergyReading now = simulation.energy();
      EXPECT_LE(now.H, H + now.round_off) << method << " step " << n;
      EXPECT_TRUE(simulation.state().z.allFinite());
      H = now.H;
    }
    EXPECT_GT(fallbacks, 0) << method;
  }
}

TEST(FailureMode, WithAToleranceTheSameRunIsAccurateAtTheCostOfShortSteps) {
  Problem problem = duffing_case();
  problem.initial *= 100;
  const Reference reference = make_reference(problem, std::vector{0.0, 1.0});
  Simulation simulation(problem, {.method = "egc6", .variable_steps = true});
  const RunReport report =
      integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                         {.tolerance = 1e-6, .t_end = 1.0, .first_h = 1.0, .law = {true, "damped"}});
  EXPECT_EQ(report.status, RunReport::Status::success) << report.message;
  EXPECT_EQ(report.law, LawVerdict::holds);
  EXPECT_GT(report.rejected, 0);
  const Vector z = simulation.physical();  // velocities are a hundred times the places
  EXPECT_NEAR(z[0], reference.state(1)[0], 1e-7);
  EXPECT_NEAR(z[1], reference.state(1)[1], 1e-5);
}

class AllSteps final : public Observer {
 public:
  bool is_due(const State&, bool) const override { return true; }
  void observe(const State&, const EnergyReading&) override {}
  void finish(const RunReport&) override {}
};

// The solution blows up at t ≈ 0.36 and C follows it until round-off alone exceeds everything there was.
TEST(FailureMode, RoundOffAboveTheEnergyIsNoExcuseForARise) {
  Problem problem = klein_gordon_case(0.1, -1.0);
  problem.initial.head(20).setConstant(5);
  problem.initial.tail(20).setZero();
  Simulation simulation(problem, {.method = "seisav"});
  AllSteps every;
  const std::vector<Observer*> observers = {&every};
  const RunReport report = integrate(simulation.system(), simulation.stepper(), simulation.state(),
                                     {.h = 1.0 / 256, .t_end = 0.46, .law = {true, "damped"}}, observers);
  EXPECT_NE(report.law, LawVerdict::holds) << report.message;
}

TEST(FailureMode, AnEnergyThatIsUnboundedBelowFailsAtHugeStepsWithTheEnergiesAndTheStateAsItWas) {
  Problem problem = klein_gordon_case(0.1, -1.0);
  problem.initial *= 40;  // beyond the rim: H < 0, and the exact solution blows up
  for (const std::string& method : collocation) {
    Simulation simulation(problem, {.method = method});
    StepReport report;
    Vector before;
    int steps = 0;
    for (; steps < 1000 && report.solved(); ++steps) {
      before = simulation.state().z;
      report = simulation.step(2.0);
    }
    ASSERT_FALSE(report.solved()) << method << " made " << steps << " steps into a blow-up";
    EXPECT_EQ(simulation.state().z, before) << method;
    EXPECT_NE(report.message.find("H(0) = "), std::string::npos) << report.message;
    EXPECT_NE(report.message.find("halvings"), std::string::npos) << report.message;
  }
}

// Damping that feeds the high modes by 10⁴⁰ in a step: e^{hL}z, which stands for the solution there, has an energy that
// only z = 0 brings down again.
TEST(FailureMode, AStepThatLeavesNothingOfTheStateIsNoSolution) {
  Problem problem = klein_gordon_case(-460, 1.0);
  for (const std::string& method : collocation) {
    Simulation simulation(problem, {.method = method});
    const RunReport report = integrate(simulation.system(), simulation.stepper(), simulation.state(),
                                       {.h = 0.2, .t_end = 20, .law = {false, "fed"}});
    EXPECT_EQ(report.status, RunReport::Status::failed) << method;
    EXPECT_NE(report.message.find("has lost most of the state"), std::string::npos) << method << ": " << report.message;
  }
}

TEST(FailureMode, APredictorThatOverflowsIsNeitherTakenNorSilent) {
  Problem problem = duffing_case();
  problem.initial *= 1e70;  // H ~ 1e280: V of a predicted state overflows
  for (const MethodEntry& method : methods()) {
    if (!applies(method.name, problem)) continue;
    Simulation simulation(problem, {.method = std::string(method.name)});
    const double H = simulation.energy().modified;
    for (int n = 0; n < 5; ++n) {
      const Vector before = simulation.state().z;
      const StepReport report = simulation.step(1.0);
      EXPECT_TRUE(simulation.state().z.allFinite()) << method.name;
      if (report.solved()) {
        EXPECT_LE(simulation.energy().modified, H * (1 + 1e-12)) << method.name;
      } else {
        EXPECT_NE(report.message, "") << method.name;
        EXPECT_EQ(simulation.state().z, before) << method.name;
      }
    }
  }
}

// gKdV with σ = 1: the energy-compatible damping condition fails, and the exact H rises for a while.
TEST(FailureMode, WhereTheConditionFailsCollocationFollowsTheExactRiseOfH) {
  const Problem problem = gkdv_case(0.5, 1.0, 1.0);
  std::vector<double> times;
  for (int n = 0; n <= 400; ++n) times.push_back(n / 32.0);
  const Reference reference = make_reference(problem, times);
  double exact_rise = 0;
  for (std::size_t n = 1; n < times.size(); ++n)
    exact_rise = std::max(exact_rise, reference.energy(n) - reference.energy(n - 1));
  ASSERT_GT(exact_rise, 1e-6);
  Simulation simulation(problem, {.method = "egc6"});
  for (std::size_t n = 1; n < times.size(); ++n) {
    ASSERT_TRUE(simulation.step(1.0 / 32).solved());
    EXPECT_NEAR(simulation.energy().H, reference.energy(n), 1e-6) << n;
  }
}

TEST(FailureMode, SaysWhereVIsNotDefinedAndAnotherRunGoesOnFromThere) {
  const Problem problem = make_problem(read(R"toml(fields = ["q", "p"]
H = "p^2/2 + q^2/2 - 0.3*log(1 + q)"
initial = { q = "0.5", p = "-2" })toml"));
  for (const std::string method : {"seisav", "savf", "seavf"}) {
    const Solution failed = solve(problem, {.method = method, .h = 1.0, .t_end = 5});
    EXPECT_FALSE(failed.success()) << method;
    EXPECT_THAT(failed.report.message, HasSubstr("V is not a finite number at q = -1, straight ahead of t = "))
        << method;
    Problem rest = problem;
    rest.initial = failed.last();
    const Solution more = solve(rest, {.method = "egc6", .tolerance = 1e-6, .t_start = failed.report.t, .t_end = 5});
    EXPECT_TRUE(more.success()) << method << ": " << more.report.message;
  }
}

TEST(FailureMode, SaysAtWhichPointVIsNotDefined) {
  const Problem problem = make_problem(read(R"toml(fields = ["u", "v"]
length = 8.0
points = 8
H = "v^2/2 + 0.005*u_x^2 - 0.5*log(1 + u)"
initial = { u = "0", v = "-3*exp(-10*(x - 3)^2)" })toml"));
  const Solution failed = solve(problem, {.method = "seisav", .h = 0.5, .t_end = 5});
  EXPECT_FALSE(failed.success());
  EXPECT_THAT(failed.report.message, HasSubstr("V is not a finite number at u = -1 (x = 3), straight ahead of t = 0"));
}

// The bond from x = 6 to 7 alone has ended. The one that closes the ring would end too, if one end of it went back to
// the start.
TEST(FailureMode, SaysAtWhichBondVIsNotDefined) {
  const Problem problem = make_problem(read(R"toml(fields = ["u", "v"]
length = 16.0
points = 16
H = "v^2/2 - log(1 + du)"
initial = { u = "0", v = "0" })toml"));
  const Simulation simulation(problem, {.method = "seavf", .backend = "dense"});
  State s = simulation.state();
  s.z.head(16).setConstant(10);
  s.z[5] = 12;
  EXPECT_EQ(end_of_potential(problem, simulation.system(), problem.initial, s, 0.5),
            "V is not a finite number at u = 12 (x = 6) at t = 0");
}

TEST(FailureMode, TellsABlowUpFromAPotentialThatEnds) {
  const Problem problem = make_problem(read(R"toml(fields = ["q", "p"]
H = "p^2/2 - q^4"
initial = { q = "1", p = "2" })toml"));
  for (const std::string method : {"seavf", "egc8", "seilm", "seisav"}) {
    const Solution failed = solve(problem, {.method = method, .h = 1.0 / 16, .t_end = 5});
    EXPECT_FALSE(failed.success()) << method;
    EXPECT_THAT(failed.report.message, Not(HasSubstr("is not a finite number at"))) << method;
    if (method != "seisav") continue;  // the others see it while q is of moderate size
    EXPECT_THAT(failed.report.message,
                HasSubstr(" times the largest value at the start: a blow-up, of the solution or of the method"));
  }
}

// sav steps across the end of V unseen, and no energy is looked at before the step that cannot go on from there.
TEST(FailureMode, SaysWhereVIsNotDefinedThoughTheDataEndLongBefore) {
  const Problem problem = make_problem(read(R"toml(fields = ["q", "p"]
H = "p^2/2 - (1 + q)^1.5"
initial = { q = "0.5", p = "-3" })toml"));
  const Solution failed = solve(problem, {.method = "seisav", .h = 0.021, .t_end = 5, .record_every = 1000});
  EXPECT_FALSE(failed.success());
  EXPECT_EQ(failed.report.t, 0);
  EXPECT_THAT(failed.report.message, ContainsRegex("; V is not a finite number at q = -1\\.0[0-9]+ at t = 0\\.588"));
  const Solution looked = solve(problem, {.method = "seisav", .h = 0.021, .t_end = 5, .record_every = 4});
  EXPECT_THAT(looked.report.message,
              ContainsRegex("^the energy is no longer finite at t = 0\\.588 \\(step 28\\); the data end "
                            "at the last good record, t = 0\\.504 \\(step 24\\); V is not a finite "
                            "number at q = -1\\.0[0-9]+ at t = 0\\.588"))
      << "where an energy is read, too";
}

TEST(FailureMode, SaysWhatElseVDependsOnWhereItIsNotDefined) {
  const Problem problem = make_problem(read(R"toml(fields = ["q", "s", "p", "r"]
H = "p^2/2 + r^2/2 + s^4 - 0.3*log(1 + q)"
initial = { q = "0.5", s = "0", p = "-2", r = "0" })toml"));
  const Solution failed = solve(problem, {.method = "seavf", .h = 0.5, .t_end = 5});
  EXPECT_FALSE(failed.success());
  EXPECT_THAT(failed.report.message,
              HasSubstr("V is not a finite number at q = -1 (where s = 0), straight ahead of t = 1 at t ≈ 1.00"));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
