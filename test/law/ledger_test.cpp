// The energy ledger: its parts add up to the change of H, and each is what its name says.
#include <test/support/cases.hpp>
#include <test/support/repetitions.hpp>

#include <seiche/law/law.hpp>
#include <seiche/loop/adaptive.hpp>
#include <seiche/simulation/simulation.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace seiche::test {
namespace TEST_FILE {

TEST(Ledger, AddsUpToTheChangeOfHInEveryStepOfEveryMethod) {
  for (const auto& [name, problem] : all_cases()) {
    for (const MethodEntry& method : methods()) {
      if (!applies(method.name, problem)) continue;
      Simulation simulation(problem, {.method = std::string(method.name)});
      simulation.stepper().keep_ledger();
      EnergyReading before = simulation.energy();
      for (int n = 0; n < repetitions(40); ++n) {
        const StepReport report = simulation.step(1.0 / 16);
        ASSERT_TRUE(report.solved()) << name << " " << method.name << ": " << report.message;
        const EnergyReading after = simulation.energy();
        const double round_off = std::max(before.round_off, after.round_off);
        EXPECT_LE(std::abs(report.ledger.sum() - (after.H - before.H)), 4 * round_off) << name << " " << method.name;
        before = after;
      }
    }
  }
}

TEST(Ledger, LeavesEveryBitOfASolutionAsItIsWithout) {
  for (const auto& [name, problem] : all_cases()) {
    for (const MethodEntry& method : methods()) {
      if (!applies(method.name, problem)) continue;
      for (const BackendEntry& backend : quick_backends_for(problem)) {
        const SimulationOptions options{.method = std::string(method.name), .backend = std::string(backend.name)};
        Simulation without(problem, options), with(problem, options);
        with.stepper().keep_ledger();
        for (int n = 0; n < repetitions(8); ++n) {
          ASSERT_EQ(without.step(1.0 / 8).status, StepReport::Status::solved) << name << " " << method.name;
          ASSERT_EQ(with.step(1.0 / 8).status, StepReport::Status::solved) << name << " " << method.name;
        }
        EXPECT_TRUE((with.state().z.array() == without.state().z.array()).all())
            << name << " " << method.name << " " << backend.name;
      }
    }
  }
}

TEST(Ledger, ASkewSubstepKeepsItsEnergyAndTheDampingTakesTheRest) {
  const Problem p = klein_gordon_case();
  for (const MethodEntry& method : methods()) {
    if (!method.kind.splits_damping || !method.has_closure()) continue;
    Simulation simulation(p, {.method = std::string(method.name)});
    simulation.stepper().keep_ledger();
    const double round_off = simulation.energy().modified_round_off;
    for (int n = 0; n < 100; ++n) {
      const StepLedger ledger = simulation.step(1.0 / 32).ledger;
      EXPECT_LE(std::abs(ledger.substep), round_off) << method.name;
      EXPECT_LT(ledger.damping_left, 0) << method.name;
      EXPECT_LT(ledger.damping_right, 0) << method.name;
      EXPECT_EQ(ledger.auxiliary != 0, method.kind.takes_C) << method.name;
    }
  }
  // merged damping is a dissipation of S: −γh|v̄|² with Δu = hv̄ for Crank–Nicolson
  for (const char* method : {"avf", "lm"}) {
    Simulation merged(p, {.method = method});
    merged.stepper().keep_ledger();
    const double h = 1.0 / 32;
    for (int n = 0; n < 50; ++n) {
      const Vector before = merged.physical();
      const StepReport report = merged.step(h);
      const Index points = before.size() / 2;
      const Vector du = merged.physical().head(points) - before.head(points);
      EXPECT_NEAR(report.ledger.substep, -0.1 / h * du.squaredNorm(), merged.energy().round_off) << method;
    }
  }
  Simulation whole(p, {.method = "avf"});
  whole.stepper().keep_ledger();
  const StepLedger ledger = whole.step(1.0 / 32).ledger;
  EXPECT_LT(ledger.substep, -1e-6);
  EXPECT_EQ(ledger.damping_left, 0);
}

// gKdV with a frozen auxiliary: V is measured outside the half-flows, and H of the substep is missed by all of that.
// What the scalar equation leaves is told apart from the dissipation of S, which is 0.
TEST(Ledger, TellsWhatAScalarEquationLeavesFromTheDissipationOfS) {
  const Problem p = gkdv_case(0.5, 1.0, 1.0);
  Simulation frozen(
      p, {.method = "seilm",
          .method_options = {.C = {}, .auxiliary = AuxiliaryMode::frozen, .scalar_solver = ScalarSolver::newton}});
  Simulation robust(p, {.method = "seilm"});
  double missed = 0;
  for (Simulation* simulation : {&frozen, &robust}) {
    simulation->stepper().keep_ledger();
    for (int n = 0; n < 100; ++n) {
      const StepReport report = simulation->step(1.0 / 64);
      ASSERT_TRUE(report.solved()) << report.message;
      const double round_off = simulation->energy().round_off;
      EXPECT_LE(std::abs(report.ledger.substep), 2 * round_off) << "S is skew";
      if (simulation == &robust) {
        EXPECT_LE(std::abs(report.ledger.scalar), round_off);
      } else {
        missed = std::max(missed, std::abs(report.ledger.scalar));
      }
    }
  }
  EXPECT_GT(missed, 1e-4);
}

TEST(Ledger, ScalarResidualsOfImplicitMethodsAreRoundOff) {
  for (const char* method : {"avf", "savf", "seavf", "slm", "seidm"}) {
    for (const Problem& problem : {fpu_conservative_case(), klein_gordon_case()}) {
      if (!applies(method, problem)) continue;
      Simulation simulation(problem, {.method = method});
      simulation.stepper().keep_ledger();
      bool any = false;
      for (int n = 0; n < 50; ++n) {
        const StepLedger ledger = simulation.step(1.0 / 16).ledger;
        EXPECT_LE(std::abs(ledger.scalar), simulation.energy().round_off) << method;
        any = any || ledger.scalar != 0;
      }
      EXPECT_TRUE(any) << method << " solves an equation";
    }
  }
}

TEST(Ledger, OfCollocationHoldsTheDissipationOfTheExactSolution) {
  Simulation simulation(klein_gordon_case(), {.method = "egc8"});
  simulation.stepper().keep_ledger();
  StepLedger total;
  const double start = simulation.energy().H;
  for (int n = 0; n < 80; ++n) total += simulation.step(1.0 / 16).ledger;
  EXPECT_NEAR(total.damping_left, simulation.energy().H - start, 1e-11);
  EXPECT_LE(std::abs(total.projection), 1e-10);
}

TEST(Ledger, CountsNoRejectedStep) {
  class Watch final : public Observer {
   public:
    bool is_due(const State&, bool) const override { return true; }
    void observe(const State&, const EnergyReading& energy) override { last = energy; }
    void finish(const RunReport&) override {}
    EnergyReading last;
  };
  const Problem problem = duffing_case();
  for (const std::string method : {"egc4", "seimp", "etdrk4", "crkn6", "chin4"}) {
    Watch watch;
    Simulation simulation(problem, {.method = method, .variable_steps = true});
    const std::vector<Observer*> observers = {&watch};
    simulation.stepper().keep_ledger();
    const double start = simulation.energy().H;
    const RunReport report = integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                                                {.tolerance = 1e-6, .t_end = 20, .first_h = 4.0}, observers);
    EXPECT_GT(report.rejected, 0) << method << ": the first step was far too long";
    EXPECT_NEAR(watch.last.ledger.sum(), watch.last.H - start, 1e-12) << method;
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
