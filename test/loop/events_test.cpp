// Events: met where they happen, in steps of any length, and the run goes on from there.
#include <test/support/cases.hpp>

#include <seiche/config/custom/custom_problem.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/formula/formula_compiler.hpp>
#include <seiche/law/law.hpp>
#include <seiche/loop/adaptive.hpp>
#include <seiche/loop/integrate.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/oscillator.hpp>
#include <seiche/simulation/simulation.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace seiche::test {
namespace TEST_FILE {

// q'' + q = 0 from q = 1 at rest: q = cos t, which first vanishes at π/2.
TEST(Adaptive, AnEventIsMetWhereItHappensAndTheRunGoesOnFromThere) {
  const Problem p = oscillator({.alpha = 0.0});
  for (const std::string method : {"egc6", "egc2", "seisav"}) {
    const double tolerance = method == "egc6" ? 1e-10 : 1e-6;
    Simulation simulation(p, {.method = method, .backend = "dense", .variable_steps = true});
    const auto position = [](double, const Vector& z) { return z[0]; };
    const auto bounce = [](State& state) {
      state.z[1] = -state.z[1];
      return true;
    };
    const std::vector<Event> events = {{.g = position, .action = bounce, .direction = Event::Direction::falling}};
    const RunReport report = integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                                                {.tolerance = tolerance, .t_end = 10, .events = events});
    EXPECT_EQ(report.status, RunReport::Status::success) << report.message;
    ASSERT_EQ(report.events.size(), 3) << method;  // π/2, and then after each half swing
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(report.events[i], std::numbers::pi * (0.5 + static_cast<double>(i)), 20 * tolerance) << method;
    EXPECT_NEAR(simulation.physical()[0], std::abs(std::cos(10.0)), 20 * tolerance) << method;
  }
}

TEST(Adaptive, AnEventWithoutAnActionEndsTheRun) {
  Simulation simulation(oscillator({.alpha = 0.0}), {.method = "egc8", .backend = "dense", .variable_steps = true});
  const std::vector<Event> events = {{.g = [](double, const Vector& z) { return z[0] - 0.5; }}};
  const RunReport report = integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                                              {.tolerance = 1e-10, .t_end = 10, .events = events});
  EXPECT_NEAR(report.t, std::numbers::pi / 3, 1e-9);
  EXPECT_NEAR(simulation.physical()[0], 0.5, 1e-9);
}

// Two functions that vanish together are two events.
TEST(Adaptive, EventsAtTheSameTimeAllHappen) {
  Simulation simulation(oscillator({.alpha = 0.0}), {.method = "egc6", .backend = "dense", .variable_steps = true});
  int first = 0;
  int second = 0;
  const auto counting = [](int& count) {
    return [&count](State&) {
      ++count;
      return true;
    };
  };
  const std::vector<Event> events = {{.g = [](double, const Vector& z) { return z[0]; }, .action = counting(first)},
                                     {.g = [](double, const Vector& z) { return 2 * z[0]; },
                                      .action = counting(second)}};
  integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                     {.tolerance = 1e-8, .t_end = 10, .events = events});
  EXPECT_EQ(first, 3);
  EXPECT_EQ(second, 3);
}

TEST(Adaptive, ABounceInAnyDirectionIsMetOnce) {
  Simulation simulation(oscillator({.alpha = 0.0}), {.method = "egc6", .backend = "dense", .variable_steps = true});
  int count = 0;
  const auto bounce = [&](State& state) {
    state.z[1] = -state.z[1];
    return ++count < 100;
  };
  const std::vector<Event> events = {{.g = [](double, const Vector& z) { return z[0]; }, .action = bounce}};
  const RunReport report = integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                                              {.tolerance = 1e-10, .t_end = 10, .events = events});
  EXPECT_EQ(report.status, RunReport::Status::success) << report.message;
  EXPECT_EQ(report.events.size(), 3);
}

TEST(Adaptive, ATinyEventFunctionIsNoEventAndOneThatIsNaNEndsTheRun) {
  const auto run_with = [](const std::function<double(double, const Vector&)>& g) {
    Simulation simulation(duffing_case(), {.method = "egc6", .variable_steps = true});
    const std::vector<Event> events = {{.g = g}};
    return integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                              {.tolerance = 1e-6, .t_end = 60, .events = events});
  };
  const RunReport tiny = run_with([](double t, const Vector&) { return std::exp(-10 * t); });
  EXPECT_EQ(tiny.status, RunReport::Status::success) << tiny.message;
  EXPECT_TRUE(tiny.events.empty());
  const RunReport none = run_with([](double t, const Vector&) { return std::sqrt(1 - t); });
  EXPECT_EQ(none.status, RunReport::Status::failed);
  EXPECT_NE(none.message.find("event 1"), std::string::npos) << none.message;
}

// Rows are in the order of time, also where an event lies in the very first step.
TEST(Adaptive, TimesNeverGoBackAndAnEventThatDoesNothingBreaksNoLaw) {
  class Order final : public Observer {
   public:
    bool is_due(const State&, bool) const override { return true; }
    void observe(const State& state, const EnergyReading&) override {
      EXPECT_GE(state.t, last);
      last = state.t;
    }
    void finish(const RunReport&) override {}
    double last = 0;
  };
  const Problem p =
      klein_gordon({.alpha = 1.0, .gamma = formula_rate(compile_formula("0.001*(1 + 0.5*sin(t))", {"t"}))});
  for (const std::string method : {"egc2", "egc6", "seisav", "ssav"}) {
    Simulation simulation(p, {.method = method, .variable_steps = true});
    Order order;
    const std::vector<Observer*> observers = {&order};
    const std::vector<Event> events = {{.g = [](double t, const Vector&) { return t - 0.005; },
                                        .action = [](State&) { return true; }},
                                       {.g = [](double t, const Vector&) { return std::sin(3 * t + 1); },
                                        .action = [](State&) { return true; }}};
    const RunReport report =
        integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                           {.tolerance = 1e-3, .t_end = 10, .law = promise_energy_law(p, 10), .events = events},
                           observers);
    EXPECT_EQ(report.law, LawVerdict::holds) << method << ": " << report.message;
    EXPECT_EQ(report.events.size(), 1 + 9) << method;
  }
}

// Gravity and a floor that takes half of the speed: the bounces last 2√2, √2, … and later ones less than a step.
TEST(Adaptive, BouncesShorterThanAStepAreMetToo) {
  const Problem p = custom_problem({.H = "p^2/2 + q", .initial = {{"q", "1"}, {"p", "0"}}});
  for (const bool fixed : {true, false}) {
    Simulation simulation(p, {.method = "egc4", .variable_steps = !fixed});
    int count = 0;
    const std::vector<Event> events = {{.g = [](double, const Vector& z) { return z[0]; },
                                        .action =
                                            [&](State& state) {
                                              state.z[1] *= -0.5;
                                              return ++count < 5;
                                            },
                                        .direction = Event::Direction::falling}};
    const RunReport report =
        fixed ? integrate(simulation.system(), simulation.stepper(), simulation.state(),
                          {.h = 0.7, .t_end = 10, .events = events})
              : integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                                   {.tolerance = 1e-8, .t_end = 10, .first_h = 0.7, .events = events});
    ASSERT_EQ(report.events.size(), 5) << fixed << " " << report.message;
    for (int k = 0; k < 5; ++k)
      EXPECT_NEAR(report.events[static_cast<std::size_t>(k)], std::numbers::sqrt2 * (3 - std::exp2(1 - k)), 1e-6) << k;
  }
}

// From q = 0 with q̇ = 1: the start is a zero of q, which rises, and one of 1 − p, whose slope there is 0.
TEST(Adaptive, AZeroAtTheStartIsAnEventInTheDirectionThatIsTaken) {
  const Problem p = custom_problem({.H = "p^2/2 + q^2/2", .initial = {{"q", "0"}, {"p", "1"}}});
  using Direction = Event::Direction;
  for (const bool fixed : {true, false}) {
    const auto times = [&](const std::function<double(double, const Vector&)>& g, Direction direction, bool ends) {
      Simulation simulation(p, {.method = "egc6", .variable_steps = !fixed});
      const std::vector<Event> events = {{.g = g, .action = [&](State&) { return !ends; }, .direction = direction}};
      const IntegrateOptions options{.h = 0.25, .t_end = 7, .events = events};
      return (fixed ? integrate(simulation.system(), simulation.stepper(), simulation.state(), options)
                    : integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                                         {.tolerance = 1e-8, .t_end = 7, .events = events}))
          .events;
    };
    const auto q = [](double, const Vector& z) { return z[0]; };
    EXPECT_EQ(times(q, Direction::any, false).size(), 3);  // 0, π, 2π
    EXPECT_EQ(times(q, Direction::rising, false).size(), 2);
    const std::vector<double> falling = times(q, Direction::falling, false);
    ASSERT_EQ(falling.size(), 1);
    EXPECT_NEAR(falling[0], std::numbers::pi, 1e-7);
    EXPECT_EQ(times(q, Direction::any, true), std::vector<double>{0.0});
    EXPECT_EQ(times([](double, const Vector& z) { return 1 - z[1]; }, Direction::rising, true),
              std::vector<double>{0.0});
    EXPECT_TRUE(times([](double, const Vector&) { return 0.0; }, Direction::any, true).empty());
  }
}

// A bouncing ball: infinitely many bounces before t = 10.
TEST(Adaptive, EventsThatAccumulateEndTheRun) {
  CustomProblem ball;
  ball.fields = {"q", "p"};
  ball.H = "p^2/2 + 9.81*q";
  ball.initial = {{"q", "1"}, {"p", "0"}};
  Simulation simulation(custom_problem(ball), {.method = "egc4", .variable_steps = true});
  const std::vector<Event> events = {{.g = [](double, const Vector& z) { return z[0]; },
                                      .action =
                                          [](State& state) {
                                            state.z[0] = 0;
                                            state.z[1] *= -0.8;
                                            return true;
                                          },
                                      .direction = Event::Direction::falling}};
  const RunReport report = integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                                              {.tolerance = 1e-8, .t_end = 10, .events = events});
  EXPECT_EQ(report.status, RunReport::Status::failed);
  EXPECT_NE(report.message.find("events accumulate at t = 4.06"), std::string::npos) << report.message;
}

}  // namespace TEST_FILE
}  // namespace seiche::test
