// One call for one run: asked times, events, and the solution at every time are those of the method, whichever it is.
#include <test/support/cases.hpp>

#include <seiche/core/base/error.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/method/methods.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/oscillator.hpp>
#include <seiche/simulation/solve.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace seiche::test {
namespace TEST_FILE {

Problem harmonic(double gamma = 0.0) {  // q = cos t without damping
  return oscillator({.omega_squared = 1.0, .alpha = 0.0, .gamma = constant_rate(gamma)});
}

Problem wave(double gamma = 0.1) { return klein_gordon({.alpha = 1.0, .gamma = constant_rate(gamma)}); }

// Every way to take steps: of one size, and of variable size by each kind of error estimate.
struct Way {
  std::string method;
  double h;
  std::optional<double> tolerance;
};
std::vector<Way> ways() {
  return {{"seisav", 1.0 / 64, {}}, {"seilm", 1.0 / 64, {}}, {"egc4", 1.0 / 16, {}},
          {"crkn4", 1.0 / 32, {}},  {"seisav", 0, 1e-4},     {"savf", 0, 1e-4},
          {"egc6", 0, 1e-8},        {"etdrk4", 0, 1e-6},     {"crkn6", 0, 1e-8}};
}

SolveOptions options_of(const Way& way, double t_end) {
  return {.method = way.method, .h = way.h, .tolerance = way.tolerance, .t_end = t_end};
}

double distance(const Solution& solution, std::size_t i, const Vector& z) {
  const Eigen::Map<const Vector> recorded(solution.z.data() + static_cast<Index>(i) * solution.size, solution.size);
  return (recorded - z).lpNorm<Eigen::Infinity>();
}

TEST(Solve, RecordsEveryStepAndItsEnergies) {
  const Problem p = wave();
  for (const Way& way : ways()) {
    const Solution s = solve(p, options_of(way, 2.0));
    ASSERT_TRUE(s.success()) << way.method << ": " << s.report.message;
    EXPECT_EQ(std::ssize(s.t), s.report.steps + 1) << way.method;
    EXPECT_EQ(std::ssize(s.z), std::ssize(s.t) * s.size);
    EXPECT_EQ(s.H.size(), s.t.size());
    EXPECT_EQ(s.modified.empty(), !s.report.has_modified_energy) << way.method;
    EXPECT_LE(distance(s, 0, p.initial), 1e-15);
    EXPECT_EQ(s.t.back(), 2.0);
    EXPECT_EQ(s.report.law, LawVerdict::holds) << way.method << ": " << s.report.message;
    EXPECT_TRUE(s.certificate.law.promised);
  }
}

// The same steps, whatever is asked for between them.
TEST(Solve, AskedTimesChangeNoStepAndMeetTheDenseOutput) {
  const Problem p = wave();
  std::vector<double> times = {0.0, 0.001, 0.3, 0.5, 0.77, 1.999, 2.0};
  for (const Way& way : ways()) {
    SolveOptions o = options_of(way, 2.0);
    o.dense_output = true;
    const Solution steps = solve(p, o);
    o.t_eval = times;
    const Solution asked = solve(p, o);
    const bool first_step_may_differ = way.tolerance.has_value();
    EXPECT_TRUE(first_step_may_differ || asked.report.steps == steps.report.steps) << way.method;
    ASSERT_EQ(asked.t, times) << way.method;
    ASSERT_EQ(asked.H.size(), times.size());
    std::vector<double> z(static_cast<std::size_t>(steps.size) * times.size());
    asked.sol->evaluate(times, z);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const Eigen::Map<const Vector> dense(z.data() + static_cast<Index>(i) * asked.size, asked.size);
      EXPECT_LE(distance(asked, i, dense), 1e-14) << way.method << " at t = " << times[i];
      const double modified = asked.modified.empty() ? asked.H[i] : asked.modified[i];
      EXPECT_NEAR(modified, asked.H[i], 2e-3 * std::abs(asked.H[0])) << way.method;
    }
  }
}

TEST(Solve, TheDenseOutputPassesThroughTheStepsAndIsContinuous) {
  const Problem p = wave();
  for (const Way& way : ways()) {
    SolveOptions o = options_of(way, 2.0);
    o.dense_output = true;
    const Solution s = solve(p, o);
    std::vector<double> z(static_cast<std::size_t>(s.size));
    const Eigen::Map<const Vector> dense(z.data(), s.size);
    for (std::size_t i = 0; i < s.t.size(); ++i) {
      s.sol->evaluate({&s.t[i], 1}, z);
      EXPECT_LE(distance(s, i, dense), 1e-13) << way.method << " at step " << i;
      const double before = std::max(0.0, s.t[i] * (1 - 1e-12));
      s.sol->evaluate({&before, 1}, z);
      EXPECT_LE(distance(s, i, dense), 1e-10) << way.method << " before step " << i;
    }
    const double outside = 2.5;
    EXPECT_THROW(s.sol->evaluate({&outside, 1}, z), Error);
  }
}

TEST(Solve, TheDenseOutputHasTheAccuracyOfTheSteps) {
  const Problem p = oscillator({.omega_squared = 1.0, .alpha = 2.0, .gamma = constant_rate(0.05)});
  SolveOptions tight{.method = "egc8", .tolerance = 1e-12, .t_end = 10, .dense_output = true};
  const Solution reference = solve(p, tight);
  const auto error = [&](double t, const double* z) {
    std::vector<double> exact(2);
    reference.sol->evaluate({&t, 1}, exact);
    return std::max(std::abs(z[0] - exact[0]), std::abs(z[1] - exact[1]));
  };
  for (const Way& way : ways()) {
    SolveOptions o = options_of(way, 10.0);
    o.dense_output = true;
    const Solution s = solve(p, o);
    double of_steps = 0;
    double between = 0;
    for (std::size_t i = 0; i < s.t.size(); ++i) of_steps = std::max(of_steps, error(s.t[i], s.z.data() + 2 * i));
    for (int k = 0; k <= 300; ++k) {
      const double t = k / 30.0;
      std::vector<double> z(2);
      s.sol->evaluate({&t, 1}, z);
      between = std::max(between, error(t, z.data()));
    }
    EXPECT_LE(between, 4 * of_steps) << way.method << (way.tolerance ? " by tolerance" : "");
  }
}

TEST(Solve, EventsAreMetWhereTheyAreWithEveryWayToStep) {
  for (const Way& way : ways()) {
    SolveOptions o = options_of(way, 20.0);
    o.dense_output = true;
    o.events = {{.g = [](double, const Vector& z) { return z[0]; }},
                {.g = [](double, const Vector& z) { return z[0]; },
                 .direction = Event::Direction::falling,
                 .ends_at = 2}};
    const Solution s = solve(harmonic(), o);
    ASSERT_TRUE(s.success()) << way.method << ": " << s.report.message;
    EXPECT_TRUE(s.ended_by_event);
    ASSERT_EQ(s.events[0].t.size(), 3) << way.method;
    const double allowed = way.tolerance ? 20 * *way.tolerance : 1e-10;
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(s.events[0].t[i], std::numbers::pi * (0.5 + static_cast<double>(i)), allowed) << way.method;
      EXPECT_NEAR(s.events[0].z[2 * i], 0, 1e-9) << way.method;
    }
    EXPECT_EQ(s.t.back(), s.events[1].t.back());
    EXPECT_EQ(s.report.t, s.t.back());
    std::vector<double> z(2);
    const double t = 5.0;
    s.sol->evaluate({&t, 1}, z);
    EXPECT_NEAR(z[0], std::cos(5.0), allowed) << way.method;
  }
}

TEST(Solve, ABounceIsAnActionAndTheSolutionGoesOnBehindIt) {
  for (const Way& way : ways()) {
    SolveOptions o = options_of(way, 10.0);
    o.dense_output = true;
    o.t_eval = {1.0, 3.0, 9.0, 10.0};
    o.events = {{.g = [](double, const Vector& z) { return z[0]; },
                 .direction = Event::Direction::falling,
                 .action = [](double, Vector& z) { z[1] = -z[1]; }}};
    const Solution s = solve(harmonic(), o);
    ASSERT_TRUE(s.success()) << way.method << ": " << s.report.message;
    EXPECT_FALSE(s.ended_by_event);
    ASSERT_EQ(s.events[0].t.size(), 3) << way.method;
    EXPECT_LT(s.events[0].z[1], 0) << way.method;
    ASSERT_EQ(s.t.size(), 4);
    const double allowed = way.tolerance ? 20 * *way.tolerance : 1e-9;
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(s.z[2 * i], std::abs(std::cos(s.t[i])), allowed) << way.method << " at " << s.t[i];
    EXPECT_NE(s.report.law, LawVerdict::violated) << way.method << ": " << s.report.message;
    std::vector<double> z(2);
    const double t = 9.0;
    s.sol->evaluate({&t, 1}, z);
    EXPECT_NEAR(z[0], std::abs(std::cos(9.0)), allowed) << way.method;
  }
}

TEST(Solve, StartsAnywhereAndAtAnyTime) {
  const Problem p = oscillator({.omega_squared = 1.0, .alpha = 0.0, .gamma = nullptr});
  for (const Way& way : ways()) {
    SolveOptions o = options_of(way, 5.0);
    o.t_start = 3.0;
    o.z0 = Vector(Vector::Unit(2, 1));
    const Solution s = solve(p, o);
    EXPECT_EQ(s.t.front(), 3.0);
    EXPECT_NEAR(s.z[s.z.size() - 2], std::sin(2.0), way.tolerance ? 20 * *way.tolerance : 1e-9) << way.method;
  }
}

TEST(Solve, AnObserverSeesEveryStepAndMayEndTheRun) {
  for (const Way& way : ways()) {
    SolveOptions o = options_of(way, 10.0);
    int seen = 0;
    double last = -1;
    o.t_eval = {0.25, 0.5};
    o.observer = [&](const SolveStep& step) {
      EXPECT_GT(step.t, last) << way.method;
      last = step.t;
      return ++seen < 4;
    };
    const Solution s = solve(harmonic(), o);
    EXPECT_EQ(s.report.status, RunReport::Status::interrupted) << way.method;
    EXPECT_EQ(seen, 4) << way.method;
    EXPECT_EQ(s.report.t, last) << way.method;
    EXPECT_EQ(s.t.back(), last) << way.method << ": where it ended, beside the times asked for";
    EXPECT_EQ(s.z.size(), s.t.size() * 2) << way.method;
  }
}

TEST(Solve, AStopFromOutsideLeavesWhatIsThere) {
  SolveOptions o{.h = 1e-3, .t_end = 1e3};
  int asked = 0;
  o.is_stopped = [&](double t, std::int64_t steps) { return ++asked > 100 && t > 0 && steps > 0; };
  const Solution s = solve(harmonic(), o);
  EXPECT_EQ(s.report.status, RunReport::Status::interrupted);
  EXPECT_GE(s.t.size(), 30);  // it may be asked more than once
  EXPECT_LE(s.t.size(), 105);
}

TEST(Solve, WhatACallbackThrowsComesOut) {
  struct Mine {};
  SolveOptions o{.h = 0.01, .t_end = 1};
  o.observer = [](const SolveStep& step) -> bool {
    if (step.t > 0.5) throw Mine{};
    return true;
  };
  EXPECT_THROW(solve(harmonic(), o), Mine);
}

TEST(Solve, TheLedgerSaysWhereTheEnergyWent) {
  const Solution s = solve(wave(), {.method = "egc4", .h = 1.0 / 16, .t_end = 1, .ledger = true});
  ASSERT_EQ(s.ledger.size(), s.t.size());
  for (std::size_t i = 0; i < s.t.size(); ++i) EXPECT_NEAR(s.ledger[i].sum(), s.H[i] - s.H[0], 1e-12) << s.t[i];
  EXPECT_LT(s.ledger.back().damping_left, 0);
}

TEST(Solve, MistakesAreOneSentenceWithBothValues) {
  const auto message = [](const SolveOptions& o) -> std::string {
    try {
      solve(harmonic(), o);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message({.t_end = 1}), testing::HasSubstr("h is 0"));
  EXPECT_THAT(message({.h = 0.1, .t_end = -1}), testing::HasSubstr("t_end = -1"));
  EXPECT_THAT(message({.h = 0.1, .t_end = 1, .z0 = Vector(Vector::Zero(3))}),
              testing::HasSubstr("z0 has 3 entries, but the state of oscillator has 2"));
  EXPECT_THAT(message({.h = 0.1, .t_end = 1, .t_eval = std::vector{0.5, 2.0}}), testing::HasSubstr("t_eval holds 2"));
  EXPECT_THAT(message({.h = 0.1, .t_end = 1, .t_eval = std::vector{0.5, 0.2}}), testing::HasSubstr("ascend"));
  EXPECT_THAT(message({.h = 1e-12, .t_end = 1}), testing::HasSubstr("t_eval"));
  EXPECT_THAT(message({.h = 0.1, .t_end = 1, .t_eval = std::vector{0.5}, .ledger = true}),
              testing::HasSubstr("leave out one of the two"));
  EXPECT_THAT(message({.tolerance = 1e-6,
                       .t_end = 1,
                       .events = {{.g = [](double t, const Vector&) { return t - 0.5; }}},
                       .ledger = true}),
              testing::HasSubstr("give h instead of a tolerance"));
}

TEST(Solve, SaysWhereHDoesNotResolveTheDamping) {
  const Problem overdamped = duffing_case(1000.0);
  const Solution split = solve(overdamped, {.method = "seisav", .h = 0.1, .t_end = 1});
  ASSERT_EQ(split.notes.size(), 1);
  EXPECT_NE(split.notes[0].find("seisav splits the damping"), std::string::npos) << split.notes[0];
  EXPECT_NE(split.report.message.find(split.notes[0]), std::string::npos) << split.report.message;
  EXPECT_TRUE(solve(overdamped, {.method = "egc4", .h = 0.1, .t_end = 1}).notes.empty());
}

}  // namespace TEST_FILE
}  // namespace seiche::test
