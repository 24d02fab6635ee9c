// A run that is stopped inside a step goes back to its last record, and so does what it says about its steps.
#include <test/support/cases.hpp>

#include <seiche/core/control/stop_request.hpp>
#include <seiche/loop/integrate.hpp>
#include <seiche/simulation/simulation.hpp>

#include <gtest/gtest.h>

#include <vector>

namespace seiche::test {
namespace TEST_FILE {

// Stopped in its seventh step. Every step before it counts as one that was widened, halved and unresolved.
class StopsInAStep : public Stepper {
 public:
  explicit StopsInAStep(Stepper& stepper) : stepper_(stepper) {}
  void begin(State& state) override { stepper_.begin(state); }
  StepReport step(State& state, double h) override {
    if (++steps_ == 7) throw Stopped();
    StepReport report = stepper_.step(state, h);
    report.widened = report.halved = report.unresolved = 1;
    return report;
  }
  EnergyReading energy(const State& state) const override { return stepper_.energy(state); }
  bool has_modified_energy() const override { return stepper_.has_modified_energy(); }
  void keep_ledger() override { stepper_.keep_ledger(); }

 private:
  Stepper& stepper_;
  int steps_ = 0;
};

class Keeps : public Observer {
 public:
  explicit Keeps(std::int64_t every_steps) : schedule_{.every_steps = every_steps} {}
  bool is_due(const State& state, bool last) const override { return schedule_.is_due(state.n, last); }
  void observe(const State& state, const EnergyReading& energy) override {
    steps.push_back(state.n);
    ledgers.push_back(energy.ledger);
  }
  void finish(const RunReport&) override {}
  std::vector<std::int64_t> steps;
  std::vector<StepLedger> ledgers;

 private:
  Schedule schedule_;
};

TEST(StopInsideAStep, TakesBackLedgerAndCountsOfTheStepsThatItTakesBack) {
  Simulation simulation(klein_gordon_case(), {.method = "seilm"});
  StopsInAStep stepper(simulation.stepper());
  stepper.keep_ledger();
  Keeps rows(4), ends(0);
  const std::vector<Observer*> observers = {&rows, &ends};
  const RunReport report =
      integrate(simulation.system(), stepper, simulation.state(), {.h = 1.0 / 64, .t_end = 1.0}, observers);
  EXPECT_EQ(report.status, RunReport::Status::interrupted);
  EXPECT_EQ(report.steps, 4);
  EXPECT_EQ(rows.steps, (std::vector<std::int64_t>{0, 4}));
  ASSERT_EQ(ends.steps, (std::vector<std::int64_t>{0, 4})) << "it has not seen the last record yet";
  EXPECT_NE(rows.ledgers.back().sum(), 0.0) << "there is damping";
  for (const LedgerPart& part : ledger_parts())
    EXPECT_EQ(ends.ledgers.back().*part.value, rows.ledgers.back().*part.value) << part.name;
  EXPECT_EQ(report.widened, 4);
  EXPECT_EQ(report.halved, 4);
  EXPECT_EQ(report.unresolved, 4);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
