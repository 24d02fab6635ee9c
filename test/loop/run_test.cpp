// What the time loop promises, shown on a stepper whose every step is known.
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/vector.hpp>
#include <seiche/loop/integrate.hpp>
#include <test/support/plain_space.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

namespace seiche {
namespace TEST_FILE {

using testing::HasSubstr;
using Status = RunReport::Status;

class NoPotential : public Potential {
 public:
  double value(const Vector&) const override { return 0.0; }
  double magnitude(const Vector&) const override { return 0.0; }
  double value_and_gradient(const Vector&, Vector&) const override {
    ++counts_.gradients;
    return 0.0;
  }
  void mean_gradient(const Vector&, const Vector&, Vector&) const override {}
  int degree() const override { return 0; }
  void along(const Vector&, const Vector&, std::span<double>) const override {}
  void along_ray(const Vector&, std::span<double>) const override {}
  Support support() const override { return {}; }
};

// z ← z + h, so z shows the time that was really integrated; the energy is any function of the step number.
class FakeStepper : public Stepper {
 public:
  explicit FakeStepper(const Potential& potential) : potential_(potential) {}

  std::function<double(std::int64_t)> energy_at = [](std::int64_t n) { return 1.0 - 1e-3 * static_cast<double>(n); };
  std::int64_t fail_at = -1;
  std::int64_t throw_at = -1;
  std::int64_t nan_at = -1;
  bool modified = false;
  double round_off = 1e-15;
  std::vector<double> sizes;
  std::function<void(std::int64_t)> after_step = [](std::int64_t) {};

  void begin(State&) override {}
  StepReport step(State& state, double h) override {
    Vector gradient;
    potential_.gradient(state.z, gradient);
    if (state.n + 1 == throw_at) throw Error("no propagator for h = {}", h);
    if (state.n + 1 == fail_at) return {.status = StepReport::Status::failed, .message = "the root was lost"};
    sizes.push_back(h);
    state.z.array() += h;
    if (state.n + 1 == nan_at) state.z[0] = std::numeric_limits<double>::quiet_NaN();
    after_step(state.n + 1);
    return {.scalar_iterations = 3, .fallbacks = 1, .unresolved = 0};
  }
  EnergyReading energy(const State& state) const override {
    const double value = std::isnan(state.z[0]) ? state.z[0] : energy_at(state.n);
    // Without a modified energy of its own, H rises for ever: the law must not look at it then.
    return modified ? EnergyReading{static_cast<double>(state.n), value, 0.0, round_off}
                    : EnergyReading{value, value, round_off, round_off};
  }
  void keep_ledger() override {}
  bool has_modified_energy() const override { return modified; }

 private:
  const Potential& potential_;
};

class Recorder : public Observer {
 public:
  explicit Recorder(Schedule schedule = {}) : schedule_(schedule) {}
  bool is_due(const State& state, bool last) const override { return schedule_.is_due(state.n, last); }
  void observe(const State& state, const EnergyReading& energy) override {
    if (state.n == throw_at) throw Error("cannot write x: the disk is full");
    steps.push_back(state.n);
    times.push_back(state.t);
    energies.push_back(energy.H);
  }
  void finish(const RunReport&) override { ++finished; }

  std::int64_t throw_at = -1;
  std::vector<std::int64_t> steps;
  std::vector<double> times, energies;
  int finished = 0;

 private:
  Schedule schedule_;
};

class TimeLoop : public testing::Test {
 protected:
  TimeLoop() {
    system.space = std::make_unique<test::PlainSpace>(2);
    system.potential = std::make_unique<NoPotential>();
    state.z = Vector::Zero(2);
  }
  RunReport run(double h, double t_end, std::vector<Observer*> observers = {}) {
    return integrate(system, stepper, state, {.h = h, .t_end = t_end, .law = law, .stop = stop}, observers);
  }

  System system;
  NoPotential potential;
  FakeStepper stepper{potential};
  State state;
  LawPromise law{.promised = true, .reason = "by construction"};
  const std::atomic<bool>* stop = nullptr;
};

TEST_F(TimeLoop, LandsOnTheEndExactlyWhereStepsDivideTheTimeUpToRoundOff) {
  for (const auto& [h, end, steps] : std::vector<std::tuple<double, double, std::int64_t>>{{0.1, 50.0, 500},
                                                                                           {0.1, 0.3, 3},
                                                                                           {1.0 / 3, 1.0, 3},
                                                                                           {0.7, 4.9, 7},
                                                                                           {1e-3, 1.1, 1100},
                                                                                           {1.0 / 256, 50, 12800}}) {
    state = State{.z = Vector::Zero(2)};
    stepper.sizes.clear();
    const RunReport report = run(h, end);
    EXPECT_EQ(report.status, Status::success) << report.message;
    EXPECT_EQ(report.steps, steps) << "h = " << h << ", end = " << end;
    EXPECT_EQ(report.t, end);
    EXPECT_EQ(state.t, end);
    for (const double size : stepper.sizes) EXPECT_EQ(size, h);
  }
}

TEST_F(TimeLoop, ShortensTheLastStepToLandOnTheEndAndSaysSo) {
  const RunReport report = run(0.3, 1.0);
  EXPECT_EQ(report.steps, 4);
  EXPECT_EQ(report.t, 1.0);
  ASSERT_EQ(stepper.sizes.size(), 4U);
  EXPECT_EQ(stepper.sizes[2], 0.3);
  EXPECT_NEAR(stepper.sizes[3], 0.1, 1e-15);
  EXPECT_NEAR(state.z[0], 1.0, 1e-15);
  EXPECT_THAT(report.message, HasSubstr("does not divide"));
  EXPECT_THAT(report.message, HasSubstr("shortened to 0.1"));
}

TEST_F(TimeLoop, AStepLongerThanTheTimeIsShortenedToIt) {
  const RunReport report = run(100.0, 0.5);
  EXPECT_EQ(report.steps, 1);
  EXPECT_EQ(report.t, 0.5);
  EXPECT_EQ(stepper.sizes, std::vector<double>{0.5});
}

TEST_F(TimeLoop, TimeIsTheStepNumberTimesTheStepSizeWithoutDrift) {
  Recorder recorder;
  run(0.1, 100.0, {&recorder});
  ASSERT_EQ(recorder.times.size(), 1001U);
  for (std::size_t n = 0; n < 1000; ++n) EXPECT_EQ(recorder.times[n], static_cast<double>(n) * 0.1);
}

TEST_F(TimeLoop, NoTimeTakesNoSteps) {
  Recorder recorder;
  const RunReport report = run(0.1, 0.0, {&recorder});
  EXPECT_EQ(report.status, Status::success);
  EXPECT_EQ(report.steps, 0);
  EXPECT_EQ(report.energy.max_increase, 0.0);
  EXPECT_EQ(recorder.steps, std::vector<std::int64_t>{0});
}

TEST_F(TimeLoop, RefusesStepSizesAndEndsThatMeanNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double h : {0.0, -0.1, nan, infinite, 1e-300}) EXPECT_THROW(run(h, 1.0), Error) << h;
  for (const double end : {-1.0, nan, infinite}) EXPECT_THROW(run(0.1, end), Error) << end;
}

TEST_F(TimeLoop, ObserversSeeTheFirstTheDueAndTheLastState) {
  Recorder every, third({.every_steps = 3}), ends({.every_steps = 0});
  run(0.1, 1.0, {&every, &third, &ends});
  EXPECT_EQ(every.steps.size(), 11U);
  EXPECT_THAT(third.steps, testing::ElementsAre(0, 3, 6, 9, 10));
  EXPECT_THAT(ends.steps, testing::ElementsAre(0, 10));
  EXPECT_EQ(every.finished + third.finished + ends.finished, 3);
}

TEST_F(TimeLoop, AFailedStepEndsTheRunWithItsReasonAndTheDataBeforeIt) {
  stepper.fail_at = 8;
  Recorder every, third({.every_steps = 3});
  const RunReport report = run(0.125, 2.0, {&every, &third});
  EXPECT_EQ(report.status, Status::failed);
  EXPECT_THAT(report.message, HasSubstr("step 8 failed after t = 0.875"));
  EXPECT_THAT(report.message, HasSubstr("the root was lost"));
  EXPECT_EQ(report.steps, 7);
  EXPECT_EQ(report.t, 0.875);
  EXPECT_EQ(state.n, 7);
  EXPECT_NEAR(state.z[0], 0.875, 1e-15);
  EXPECT_EQ(every.steps.size(), 8U) << "no state is recorded twice";
  EXPECT_THAT(third.steps, testing::ElementsAre(0, 3, 6, 7));
  EXPECT_EQ(report.energy.final, 1.0 - 7e-3);
  EXPECT_EQ(every.finished, 1);
}

TEST_F(TimeLoop, NotANumberIsAFailureAndNeverRecorded) {
  stepper.nan_at = 5;
  Recorder every;
  const RunReport report = run(0.1, 2.0, {&every});
  EXPECT_EQ(report.status, Status::failed);
  EXPECT_THAT(report.message, HasSubstr("no longer finite"));
  EXPECT_EQ(report.steps, 4);
  EXPECT_EQ(every.steps.size(), 5U);
  EXPECT_TRUE(state.z.allFinite());
}

TEST_F(TimeLoop, NotANumberBetweenRecordsIsFoundSoon) {
  stepper.nan_at = 130;
  Recorder ends({.every_steps = 0});
  const RunReport report = run(0.1, 1e6, {&ends});
  EXPECT_EQ(report.status, Status::failed);
  EXPECT_LT(stepper.sizes.size(), 200U);
  EXPECT_TRUE(state.z.allFinite());
  EXPECT_EQ(report.steps, 0) << "the last state known to be good is the last recorded one";
}

TEST_F(TimeLoop, AnEnergyThatOverflowsIsAFailure) {
  stepper.energy_at = [](std::int64_t n) { return n < 3 ? 1.0 : std::numeric_limits<double>::infinity(); };
  Recorder every;
  const RunReport report = run(0.1, 1.0, {&every});
  EXPECT_EQ(report.status, Status::failed);
  EXPECT_THAT(report.message, HasSubstr("energy is no longer finite"));
  EXPECT_TRUE(std::isfinite(report.energy.final));
  EXPECT_TRUE(std::isfinite(report.energy.max_increase));
}

TEST_F(TimeLoop, AStartThatIsNotFiniteIsAFailure) {
  state.z[0] = std::numeric_limits<double>::quiet_NaN();
  const RunReport report = run(0.1, 1.0);
  EXPECT_EQ(report.status, Status::failed);
  EXPECT_THAT(report.message, HasSubstr("at the start"));
  EXPECT_TRUE(stepper.sizes.empty());
}

TEST_F(TimeLoop, AnErrorInAStepIsAFailureWithWholeRecords) {
  stepper.throw_at = 4;
  Recorder every;
  const RunReport report = run(0.1, 1.0, {&every});
  EXPECT_EQ(report.status, Status::failed);
  EXPECT_THAT(report.message, HasSubstr("no propagator for h = 0.1"));
  EXPECT_EQ(report.steps, 3);
  EXPECT_EQ(every.finished, 1);
}

TEST_F(TimeLoop, AnObserverThatCannotWriteEndsTheRunAndTheOthersFinish) {
  Recorder broken, other;
  broken.throw_at = 4;
  const RunReport report = run(0.1, 1.0, {&broken, &other});
  EXPECT_EQ(report.status, Status::failed);
  EXPECT_THAT(report.message, HasSubstr("the disk is full"));
  EXPECT_EQ(other.finished, 1);
}

TEST_F(TimeLoop, AnEnergyThatRisesBeyondRoundOffViolatesThePromisedLaw) {
  stepper.energy_at = [](std::int64_t n) { return n == 6 ? 1.0 + 1e-12 : 1.0; };
  Recorder every;
  const RunReport report = run(0.1, 1.0, {&every});
  EXPECT_EQ(report.status, Status::success);
  EXPECT_EQ(report.law, LawVerdict::violated);
  EXPECT_NEAR(report.energy.max_increase, 1e-12, 1e-15);
  EXPECT_THAT(report.message, HasSubstr("t = 0.6"));
  EXPECT_EQ(every.steps.size(), 11U) << "a verdict, not a reason to stop";
}

TEST_F(TimeLoop, RoundOffIsNoViolationAndAddsUpOverTheStepsBetweenRecords) {
  stepper.energy_at = [](std::int64_t n) { return static_cast<double>(n) * 0x1p-52; };
  stepper.round_off = 0x1p-52;
  Recorder fifth({.every_steps = 5});
  EXPECT_EQ(run(0.1, 1.0, {&fifth}).law, LawVerdict::holds);

  state = State{.z = Vector::Zero(2)};
  stepper.round_off = 0x1p-53;
  EXPECT_EQ(run(0.1, 1.0, {&fifth}).law, LawVerdict::violated);
}

TEST_F(TimeLoop, TheLawIsAboutTheModifiedEnergyWhereThereIsOne) {
  stepper.modified = true;
  Recorder every;
  const RunReport report = run(0.1, 1.0, {&every});
  EXPECT_EQ(report.law, LawVerdict::holds);
  EXPECT_EQ(report.energy.max_increase, 1.0);
  EXPECT_LT(report.modified.max_increase, 0.0) << "it always fell";
  EXPECT_EQ(report.modified.initial, 1.0);
}

TEST_F(TimeLoop, WithoutAPromiseThereIsNoVerdictButTheReason) {
  law = {.promised = false, .reason = "M is indefinite"};
  stepper.energy_at = [](std::int64_t n) { return static_cast<double>(n); };
  const RunReport report = run(0.1, 1.0);
  EXPECT_EQ(report.law, LawVerdict::not_promised);
  EXPECT_THAT(report.message, HasSubstr("M is indefinite"));
  EXPECT_EQ(report.energy.max_increase, 10.0) << "first and last are always read";
}

TEST_F(TimeLoop, TheStopFlagEndsTheRunAfterTheCurrentStep) {
  std::atomic<bool> flag = false;
  stop = &flag;
  stepper.after_step = [&](std::int64_t n) { flag = n == 5; };
  Recorder every, ends({.every_steps = 0});
  const RunReport report = run(0.1, 1.0, {&every, &ends});
  EXPECT_EQ(report.status, Status::interrupted);
  EXPECT_EQ(report.steps, 5);
  EXPECT_EQ(every.steps.size(), 6U);
  EXPECT_THAT(ends.steps, testing::ElementsAre(0, 5));
  EXPECT_EQ(ends.finished, 1);
}

TEST_F(TimeLoop, CountsOfStepsAddUp) {
  NoPotential& counted = static_cast<NoPotential&>(*system.potential);
  FakeStepper fake(counted);
  const RunReport report = integrate(system, fake, state, {.h = 0.1, .t_end = 1.0});
  EXPECT_EQ(report.scalar_iterations, 30);
  EXPECT_EQ(report.fallbacks, 10);
  EXPECT_EQ(report.potential_counts.gradients, 10);
}

}  // namespace TEST_FILE
}  // namespace seiche
