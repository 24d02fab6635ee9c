// A run that is asked to stop does so inside a step, where that takes long.
#include <test/support/cases.hpp>

#include <seiche/core/control/stop_request.hpp>
#include <seiche/loop/integrate.hpp>
#include <seiche/simulation/simulation.hpp>

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>

namespace seiche::test {
namespace TEST_FILE {

// Never ends its fourth step, in which it has moved the state already, and is asked to stop there.
class HangsInAStep : public Stepper {
 public:
  HangsInAStep(Stepper& stepper, std::atomic<bool>& stop) : stepper_(stepper), stop_(stop) {}
  void begin(State& state) override { stepper_.begin(state); }
  StepReport step(State& state, double h) override {
    StepReport report = stepper_.step(state, h);
    if (++steps_ == 4)
      for (stop_ = true;;) end_if_asked();
    return report;
  }
  EnergyReading energy(const State& state) const override { return stepper_.energy(state); }
  bool has_modified_energy() const override { return stepper_.has_modified_energy(); }
  void keep_ledger() override { stepper_.keep_ledger(); }

 private:
  Stepper& stepper_;
  std::atomic<bool>& stop_;
  int steps_ = 0;
};

TEST(StopRequest, EndsARunInsideAStepAtItsLastRecord) {
  Simulation simulation(klein_gordon_case(), {.method = "seisav"});
  std::atomic<bool> stop = false;
  HangsInAStep stepper(simulation.stepper(), stop);
  const RunReport report =
      integrate(simulation.system(), stepper, simulation.state(), {.h = 1.0 / 64, .t_end = 1.0, .stop = &stop});
  EXPECT_EQ(report.status, RunReport::Status::interrupted);
  EXPECT_EQ(report.t, 0.0) << "no other state was recorded";
  EXPECT_EQ(simulation.state().z, Simulation(klein_gordon_case(), {.method = "seisav"}).state().z);
}

TEST(StopRequest, LetsAStepEndThatIsNearlyDone) {
  const std::atomic<bool> stop = true;
  const StopRequest request(&stop);
  EXPECT_NO_THROW(end_if_asked());
}

TEST(StopRequest, IsNotThereUnlessMade) { EXPECT_NO_THROW(end_if_asked()); }

TEST(StopRequest, OfARunInsideAnotherIsItsOwn) {
  const std::atomic<bool> stop = true, go_on = false;
  const StopRequest outer(&stop);
  {
    const StopRequest inner(&go_on);
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(700);  // it answers after 500
    while (std::chrono::steady_clock::now() < end) end_if_asked();
  }
  const auto hangs = std::chrono::steady_clock::now() + std::chrono::minutes(3);
  EXPECT_THROW(while (std::chrono::steady_clock::now() < hangs) end_if_asked(), Stopped);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
