// Runs with a tolerance come to their end, or say why they do not.
#include <test/support/program.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/config/custom/custom_problem.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/law/law.hpp>
#include <seiche/loop/adaptive.hpp>
#include <seiche/loop/run_pace.hpp>
#include <seiche/problem/oscillator.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/simulation/solve.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace seiche::test {
namespace TEST_FILE {

using testing::HasSubstr;

struct Ended {
  RunReport report;
  Vector z;
};

Ended run(const Problem& problem, const std::string& method, double tolerance, double t_end) {
  Simulation simulation(problem, {.method = method, .variable_steps = true, .tolerance = tolerance, .duration = t_end});
  const RunReport report =
      integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                         {.tolerance = tolerance, .t_end = t_end, .law = promise_energy_law(simulation, t_end)});
  return {report, simulation.physical()};
}

// Over the rim of its well, and from there to infinity at t ≈ 7.203.
Problem over_the_rim() {
  return custom_problem(
      {.H = "p^2/2 + q^2/2 - q^3/3", .D = {{"0", "0"}, {"0", "0.05"}}, .initial = {{"q", "1.01"}, {"p", "0"}}});
}

TEST(RunThatEnds, MethodsOfOrderTwoReachABlowUpAndFailThere) {
  for (const char* method : {"seisav", "eisav", "sav", "ssav", "seilm", "seavf", "egc2", "strang_exact"}) {
    const Ended ended = run(over_the_rim(), method, 1e-3, 8);
    EXPECT_EQ(ended.report.status, RunReport::Status::failed) << method;
    EXPECT_NEAR(ended.report.t, 7.2, 0.1) << method << ": " << ended.report.message;
    EXPECT_NE(ended.report.law, LawVerdict::violated) << method << ": " << ended.report.message;
    EXPECT_LE(ended.report.steps, 1 << 19) << method;
    EXPECT_TRUE(ended.z.allFinite()) << method;
  }
}

// What drifts between r² and V + C grows with time, and with it an error of the force that no step size lowers.
TEST(RunThatEnds, StepsOfTheSavFamilyDoNotShrinkWithTheDriftOfTheAuxiliaryVariable) {
  const Problem undamped = oscillator({.gamma = nullptr});
  const Ended early = run(undamped, "seisav", 1e-2, 100);
  const Ended late = run(undamped, "seisav", 1e-2, 2000);
  ASSERT_EQ(late.report.status, RunReport::Status::success) << late.report.message;
  EXPECT_EQ(late.report.law, LawVerdict::holds) << late.report.message;
  EXPECT_LE(late.report.steps, 30 * early.report.steps);
}

TEST(RunThatEnds, SplittingsGoOnWithASolutionThatHasFaded) {
  const DampingRate gamma = constant_rate(0.1);
  Problem linear = oscillator({.alpha = 0.0, .gamma = gamma});
  linear.potential = nullptr;
  for (const Problem& problem : {linear, oscillator({.gamma = gamma})})
    for (const char* method : {"crkn4", "crkn6", "strang_exact", "chin4", "auto"})
      for (const double t_end : {1e8, 1e15}) {
        const Ended ended = run(problem, method, 1e-6, t_end);
        EXPECT_EQ(ended.report.status, RunReport::Status::success) << method << ": " << ended.report.message;
        EXPECT_LE(10 * ended.report.rejected, ended.report.steps + 400) << method << " " << t_end;
        EXPECT_LE(ended.report.steps, 50000) << method << " " << t_end;
        EXPECT_LE(ended.z.lpNorm<Eigen::Infinity>(), 1e-6) << method << " " << t_end;
      }
}

// A run of attempts of lengths h(t); returns the attempt after which it was ended, or 0.
struct Pace {
  double t_end = 1;
  Index unknowns = 2;
  std::function<double(double t)> h;
  std::function<double(double t)> size = [](double) { return 1.0; };
  std::int64_t most = 1 << 25;

  std::int64_t ended_at(std::string* why = nullptr) const {
    RunPace pace(0, t_end, unknowns);
    double t = 0;
    for (std::int64_t n = 1; n <= most && t < t_end; ++n) {
      const double step = h(t);
      t += step;
      const std::string reason = pace.objection(t, step, [&] { return size(t); });
      if (reason.empty()) continue;
      if (why != nullptr) *why = reason;
      return n;
    }
    return 0;
  }
};

TEST(RunThatEnds, ARunWhoseStepsShrinkTowardsABlowUpEndsSoon) {
  std::string why;
  const auto left = [](double t) { return std::max(1 - t, 1e-14); };
  const Pace blow_up{.t_end = 2,
                     .h = [&](double t) { return 1e-3 * std::pow(left(t), 2.5); },
                     .size = [&](double t) { return std::pow(left(t), -3); }};
  EXPECT_GT(blow_up.ended_at(&why), 0);
  EXPECT_LE(blow_up.ended_at(), 1 << 20);
  EXPECT_THAT(why, HasSubstr("would not pass t = 1.0"));
  Pace before = blow_up;
  before.t_end = 0.97;
  EXPECT_EQ(before.ended_at(), 0);
}

TEST(RunThatEnds, ARunWhoseStepsHaveCollapsedEndsAfterMillionsOfThem) {
  std::string why;
  const Pace collapsed{.t_end = 8, .h = [](double t) { return t < 4.7 ? 5e-3 : 4e-9; }};
  const std::int64_t attempts = collapsed.ended_at(&why);
  EXPECT_GT(attempts, 1 << 20);
  EXPECT_THAT(why, HasSubstr("collapsed"));
  Pace large = collapsed;
  large.unknowns = 10000;  // a step takes a hundred times as long
  EXPECT_LE(50 * large.ended_at(), attempts);
}

TEST(RunThatEnds, ARunTooLongForAnyMachineIsEnded) {
  std::string why;
  EXPECT_GT((Pace{.t_end = 1e15, .h = [](double) { return 1.0; }}.ended_at(&why)), 0);
  EXPECT_THAT(why, HasSubstr("would not end"));
}

TEST(RunThatEnds, LongRunsLayersPulsesAndNearCollisionsGoOn) {
  const std::int64_t most = 1 << 22;
  EXPECT_EQ((Pace{.t_end = 1e7, .h = [](double) { return 0.01; }, .most = most}.ended_at()), 0) << "long";
  for (const double h : {1e-9, 2.5e-10})
    EXPECT_EQ((Pace{.t_end = 1e3, .h = [h](double t) { return t < 1e-3 ? h : 0.1; }, .most = 4 * most}.ended_at()), 0)
        << "a layer of a million steps and more at the start, h = " << h;
  EXPECT_EQ((Pace{.t_end = 1e5, .h = [](double t) { return 1e-7 * std::exp(t / 6); }, .most = 32 * most}.ended_at()), 0)
      << "a fast mode that decays beside a slow one";
  EXPECT_EQ((Pace{.t_end = 1e3, .h = [](double t) { return std::abs(t - 100) < 1e-3 ? 2e-9 : 0.01; }, .most = most}
                 .ended_at()),
            0)
      << "a pulse";
  EXPECT_EQ((Pace{.t_end = 1e3,
                  .h = [](double t) { return 1e-3 * std::pow(std::abs(std::sin(t / 2)) + 1e-3, 1.5); },
                  .size = [](double t) { return 1 / (std::abs(std::sin(t / 2)) + 1e-2); },
                  .most = most}
                 .ended_at()),
            0)
      << "near collisions, again and again";
  EXPECT_EQ((Pace{.t_end = 60,
                  .h = [](double t) { return 1e-2 * std::exp(-t / 4); },
                  .size = [](double t) { return std::exp(t / 2); },
                  .most = most}
                 .ended_at()),
            0)
      << "exponential growth";
  EXPECT_EQ((Pace{.t_end = 1e18,
                  .h = [](double t) { return 1e-5 * std::exp(t / 5); },
                  .size = [](double t) { return std::exp(-t); },
                  .most = most}
                 .ended_at()),
            0)
      << "a solution that fades";
}

// A pulse of a force that ends inside the first step of a method with history.
TEST(RunThatEnds, EveryEntryPointFollowsAPulseInsideTheFirstStep) {
  const Problem p =
      make_problem(parse_case("[problem]\nname = \"oscillator\"\nomega_squared = 1.0\nalpha = 1.0\n"
                              "force = \"50*exp(-((t - 0.004)/0.0005)^2)\"",
                              "x.toml"));
  const Ended direct = run(p, "egc6", 1e-6, 1);
  const Solution solved = solve(p, {.method = "egc6", .tolerance = 1e-6, .t_end = 1});
  const Vector last = solved.last();
  EXPECT_LE((last - direct.z).lpNorm<Eigen::Infinity>(), 1e-12);
  EXPECT_EQ(solved.report.rejected, direct.report.rejected);
}

class RunThatEndsCli : public Cli {};

TEST_F(RunThatEndsCli, TheProgramSaysWhatToTryAndLeavesItsData) {
  write("case.toml",
        "[problem]\nname = \"custom\"\nfields = [\"q\", \"p\"]\nH = \"p^2/2 + q^2/2 - q^3/3\"\nD = { p = \"0.05\" }\n"
        "initial = { q = \"1.01\", p = \"0\" }\n[method]\nname = \"seisav\"\ntolerance = 1e-2\n[time]\nend = 8.0\n"
        "[output]\nenergy_every = 1000\nsnapshot_every = 0\n");
  const Result result = seiche("run case.toml --out out --json");
  EXPECT_EQ(result.exit, 1) << result.err;
  EXPECT_THAT(result.out, HasSubstr("the steps shrink without end"));
  EXPECT_THAT(result.out, HasSubstr("take a larger tolerance"));
  const double last = std::stod(lines("out/energy.csv").back());
  EXPECT_NEAR(last, 7.2, 0.1);
  EXPECT_EQ(lines("out/final.txt").size(), 2U);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
