// A call that goes on from a checkpoint ends with the solution of one that was never stopped: its times, states,
// energies, events and what is between them.
#include <test/support/cases.hpp>
#include <test/support/error_of.hpp>

#include <seiche/damping/rates.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/oscillator.hpp>
#include <seiche/simulation/solve.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

using testing::HasSubstr;

// Keeps a checkpoint of every so many steps.
class Keeper : public Checkpoints {
 public:
  explicit Keeper(std::int64_t every, std::int64_t stops_at = -1) : every_(every), stops_at_(stops_at) {}
  void save(std::int64_t n, double t, FunctionRef<void(Archive&)> run) override {
    steps.push_back(n);
    times.push_back(t);
    std::string bytes;
    Archive archive([&bytes](std::string_view piece) { bytes += piece; });
    run(archive);
    saved.push_back(std::move(bytes));
  }
  std::vector<std::string> saved;
  std::vector<std::int64_t> steps;
  std::vector<double> times;

 private:
  Wish look(std::int64_t n) override {
    if (n == stops_at_) return Wish::save_and_stop;
    return n % every_ == 0 ? Wish::save : Wish::none;
  }
  std::int64_t every_, stops_at_;
};

struct ACall {
  std::string name;
  Problem problem;
  SolveOptions options;
};

// A ball on a spring above a floor, where it is thrown up again.
SolveEvent bounce(std::int64_t ends_at = 0) {
  return {.g = [](double, const Vector& z) { return z[0] + 0.25; },
          .direction = Event::Direction::falling,
          .ends_at = ends_at,
          .action = [](double, Vector& z) { z[1] = -z[1]; }};
}
SolveEvent turns_back() {
  return {.g = [](double, const Vector& z) { return z[1]; }};
}

std::vector<ACall> calls() {
  const Problem ball = oscillator({.omega_squared = 1.0, .alpha = 0.5, .gamma = constant_rate(0.05)});
  const Problem wave = klein_gordon({.alpha = 1.0, .gamma = constant_rate(0.1)});
  const SolveOptions fixed{.method = "seisav", .h = 1.0 / 16, .t_end = 12.01};
  const SolveOptions remembered{.method = "egc4", .h = 1.0 / 8, .t_end = 12};
  const SolveOptions variable{.method = "seisav", .tolerance = 1e-3, .t_end = 12};
  const SolveOptions high{.method = "egc6", .tolerance = 1e-6, .t_end = 12};
  std::vector<ACall> all;
  const auto add = [&](const std::string& name, const Problem& problem, SolveOptions options,
                       const std::function<void(SolveOptions&)>& change) {
    change(options);
    all.push_back({name + " " + options.method, problem, std::move(options)});
  };
  for (const SolveOptions& options : {fixed, remembered, variable, high}) {
    add("bounces", ball, options, [](SolveOptions& o) { o.events = {bounce(), turns_back()}; });
    add("ends by an event", ball, options, [](SolveOptions& o) { o.events = {bounce(3)}; });
    add("asked times", ball, options, [](SolveOptions& o) {
      o.t_eval = std::vector<double>{0.0, 0.01, 0.1, 2.5, 2.51, 7.7, 12.0};
      o.events = {turns_back()};
    });
    add("dense", ball, options, [](SolveOptions& o) {
      o.dense_output = true;
      o.events = {bounce()};
    });
    add("wave", wave, options, [](SolveOptions& o) { o.record_every = 7; });
  }
  add("ledger", wave, fixed, [](SolveOptions& o) { o.ledger = true; });
  return all;
}

void expect_same(const Solution& one, const Solution& other, const std::string& where) {
  EXPECT_EQ(one.t, other.t) << where;
  EXPECT_EQ(one.z, other.z) << where;
  EXPECT_EQ(one.H, other.H) << where;
  EXPECT_EQ(one.modified, other.modified) << where;
  ASSERT_EQ(one.ledger.size(), other.ledger.size()) << where;
  for (std::size_t i = 0; i < one.ledger.size(); ++i)
    for (const LedgerPart& part : ledger_parts())
      EXPECT_EQ(one.ledger[i].*part.value, other.ledger[i].*part.value) << where << " " << part.name;
  ASSERT_EQ(one.events.size(), other.events.size()) << where;
  for (std::size_t i = 0; i < one.events.size(); ++i) {
    EXPECT_EQ(one.events[i].t, other.events[i].t) << where;
    EXPECT_EQ(one.events[i].z, other.events[i].z) << where;
  }
  EXPECT_EQ(one.ended_by_event, other.ended_by_event) << where;
  EXPECT_EQ(one.report.message, other.report.message) << where;
  EXPECT_EQ(one.report.law, other.report.law) << where;
  EXPECT_EQ(one.report.steps, other.report.steps) << where;
  EXPECT_EQ(one.report.events, other.report.events) << where;
  EXPECT_EQ(one.report.energy.max_increase, other.report.energy.max_increase) << where;
  ASSERT_EQ(one.sol != nullptr, other.sol != nullptr) << where;
  if (!one.sol) return;
  const std::vector<double> times = {one.sol->t_start(), 0.3, 1.7, 4.4, 9.9, one.sol->t_end()};
  std::vector<double> a(times.size() * static_cast<std::size_t>(one.size)), b = a;
  one.sol->evaluate(times, a);
  other.sol->evaluate(times, b);
  EXPECT_EQ(a, b) << where;
}

TEST(SolveCheckpoints, GoOnToTheSameSolution) {
  int events = 0;
  for (const ACall& call : calls()) {
    SolveOptions kept = call.options;
    Keeper keeper(1);
    kept.resumption.checkpoints = &keeper;
    const Solution whole = solve(call.problem, kept);
    ASSERT_TRUE(whole.success()) << call.name << ": " << whole.report.message;
    expect_same(solve(call.problem, call.options), whole, call.name + " kept");
    for (const Solution::Events& of_one : whole.events) events += static_cast<int>(of_one.t.size());
    ASSERT_GT(keeper.saved.size(), 2U) << call.name;
    for (std::size_t k = 0; k < keeper.saved.size(); k += keeper.saved.size() / 60 + 1) {
      SolveOptions going_on = call.options;
      Archive from(keeper.saved[k]);
      going_on.resumption.from = &from;
      expect_same(solve(call.problem, going_on), whole, call.name + " from step " + std::to_string(keeper.steps[k]));
      EXPECT_TRUE(from.is_at_end()) << call.name;
    }
  }
  EXPECT_GT(events, 60);
}

// Actions and observers are not called again for what the checkpoint has seen.
TEST(SolveCheckpoints, CallNothingTwice) {
  const ACall call = calls().front();
  int actions = 0, shown = 0;
  SolveOptions options = call.options;
  options.events.front().action = [&](double, Vector& z) {
    z[1] = -z[1];
    ++actions;
  };
  options.observer = [&](const SolveStep&) {
    ++shown;
    return true;
  };
  solve(call.problem, options);
  const int all_actions = actions, all_shown = shown;
  ASSERT_GT(all_actions, 2);
  actions = shown = 0;
  Keeper keeper(1'000'000, 100);
  options.resumption.checkpoints = &keeper;
  EXPECT_EQ(solve(call.problem, options).report.status, RunReport::Status::interrupted);
  EXPECT_GT(actions, 0);
  Archive from(keeper.saved.back());
  options.resumption = {.checkpoints = nullptr, .from = &from};
  EXPECT_TRUE(solve(call.problem, options).success());
  EXPECT_EQ(actions, all_actions);
  EXPECT_EQ(shown, all_shown);
}

TEST(SolveCheckpoints, OfAnotherCallAreRefused) {
  const ACall call = calls().front();
  SolveOptions kept = call.options;
  Keeper keeper(50);
  kept.resumption.checkpoints = &keeper;
  solve(call.problem, kept);
  const auto refusal = [&](const std::function<void(SolveOptions&)>& change, Problem problem) {
    SolveOptions options = call.options;
    change(options);
    Archive from(keeper.saved[1]);
    options.resumption.from = &from;
    return error_of([&] { solve(problem, options); });
  };
  EXPECT_EQ(refusal([](SolveOptions&) {}, call.problem), "");
  EXPECT_EQ(refusal([](SolveOptions& o) { o.t_end = 20; }, call.problem), "") << "it may go farther";
  EXPECT_THAT(refusal([](SolveOptions& o) { o.h = 1.0 / 8; }, call.problem),
              HasSubstr("that one steps with h = 0.0625, from t = 0"));
  EXPECT_THAT(refusal([](SolveOptions& o) { o.method = "seilm"; }, call.problem), HasSubstr("by seilm"));
  EXPECT_THAT(refusal([](SolveOptions& o) { o.events.pop_back(); }, call.problem), HasSubstr("another call"));
  EXPECT_THAT(refusal([](SolveOptions& o) { o.events.front().ends_at = 2; }, call.problem), HasSubstr("an event"));
  EXPECT_THAT(refusal([](SolveOptions& o) { o.t_eval.emplace(); }, call.problem), HasSubstr("its t_eval has other"));
  const Problem damped = oscillator({.omega_squared = 1.0, .alpha = 0.5, .gamma = constant_rate(0.06)});
  EXPECT_THAT(refusal([](SolveOptions&) {}, damped), HasSubstr("its equation (M, S, D, V or a parameter) has other"));
  const Problem harder = oscillator({.omega_squared = 1.0, .alpha = 0.51, .gamma = constant_rate(0.05)});
  EXPECT_THAT(refusal([](SolveOptions&) {}, harder), HasSubstr("its equation"));
  EXPECT_THAT(refusal([](SolveOptions& o) { o.t_eval = std::vector<double>{1}; }, call.problem),
              HasSubstr("its t_eval has other numbers"));
  EXPECT_THAT(refusal([&](SolveOptions& o) { o.z0 = Vector(2 * call.problem.initial); }, call.problem),
              HasSubstr("its z0 has other numbers"));
  EXPECT_THAT(refusal([](SolveOptions&) {}, klein_gordon_case()), HasSubstr("another call"));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
