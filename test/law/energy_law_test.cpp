// The energy laws: any step size, every method, every problem whose hypotheses hold.
#include <test/support/cases.hpp>
#include <test/support/repetitions.hpp>
#include <test/support/worst.hpp>

#include <seiche/damping/rates.hpp>
#include <seiche/formula/formula_compiler.hpp>
#include <seiche/law/law.hpp>
#include <seiche/problem/chain.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/nls.hpp>
#include <seiche/simulation/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace seiche::test {
namespace TEST_FILE {

struct LawRun {
  double worst_increase = -std::numeric_limits<double>::infinity();  // of the method's energy, in units of round-off
  int steps = 0;
  bool finished = true;
};

LawRun run(const Problem& problem, std::string_view method, std::string_view backend, double h, double t_end,
           const MethodOptions& options = {}) {
  Simulation simulation(problem,
                        {.method = std::string(method), .backend = std::string(backend), .method_options = options});
  LawRun result;
  EnergyReading before = simulation.energy();
  while (simulation.state().t < t_end - h / 2) {
    if (!simulation.step(h).solved()) {
      result.finished = false;
      break;
    }
    const EnergyReading after = simulation.energy();
    const double round_off = std::max(before.modified_round_off, after.modified_round_off);
    result.worst_increase = worse(result.worst_increase, (after.modified - before.modified) / round_off);
    before = after;
    ++result.steps;
  }
  return result;
}

class EveryMethod : public testing::TestWithParam<std::string> {};

TEST_P(EveryMethod, RaisesItsEnergyInNoStepOfAnySize) {
  const MethodEntry& method = find_method(GetParam());
  const std::vector<double> sizes =
      sanitized ? std::vector<double>{0.25} : std::vector<double>{1.0 / 64, 0.1, 0.25, 1.0, 2.5, 10.0};
  int finished = 0;
  int runs = 0;
  for (const auto& [name, problem] : all_cases()) {
    if (!promise_energy_law(problem, 50).promised || !applies(method.name, problem)) continue;
    for (const BackendEntry& backend : sanitized ? quick_backends_for(problem) : backends_for(problem)) {
      for (const double h : backend.name == "reference" ? std::vector<double>{0.25, 10.0} : sizes) {
        const LawRun result = run(problem, method.name, backend.name, h, std::max(3.0, 20 * h));
        EXPECT_LE(result.worst_increase, 1) << name << " " << backend.name << " h = " << h;
        ++runs;
        finished += result.finished ? 1 : 0;
        // Never fails, as it solves one linear equation a step, unless exponentials of ẑ overflow.
        const bool linear = method.kind.takes_C && name != "written_Toda";
        if (linear || h <= 0.25) {
          EXPECT_TRUE(result.finished) << name << " h = " << h;
        }
      }
    }
  }
  EXPECT_GE(runs, 20 * static_cast<int>(sizes.size()));  // problems or backends that fell away would be missed
  RecordProperty("runs", runs);
  RecordProperty("finished", finished);
  EXPECT_GE(finished, runs - runs / 10);  // a few of avf and lm at h = 10 say that they did not solve
}

TEST_P(EveryMethod, RaisesItsEnergyInNoStepFarTooLong) {
  const MethodEntry& method = find_method(GetParam());
  for (const auto& [name, problem] : golden_cases()) {
    if (!promise_energy_law(problem, 50).promised || !applies(method.name, problem)) continue;
    for (const double h : {25.0, 300.0}) {
      const LawRun result = run(problem, method.name, "auto", h, 20 * h);
      EXPECT_LE(result.worst_increase, 1) << name << " h = " << h;
      if (method.kind.takes_C) {
        EXPECT_EQ(result.steps, 20) << name << " h = " << h;
      }
    }
  }
}

// Methods that integrate the dissipation by quadratures of high order take longest.
std::vector<std::string> methods_that_are(bool slow) {
  std::vector<std::string> names;
  for (const MethodEntry& method : methods())
    if ((method.kind.holds_rate_of_start && method.order > 2) == slow) names.emplace_back(method.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(EnergyLaw, EveryMethod, testing::ValuesIn(methods_that_are(false)),
                         [](const auto& of) { return of.param; });
INSTANTIATE_TEST_SUITE_P(EnergyLawSlow, EveryMethod, testing::ValuesIn(methods_that_are(true)),
                         [](const auto& of) { return of.param; });

TEST(EnergyLaw, WithoutDampingEveryMethodKeepsItsEnergyToTwelveDigits) {
  const std::vector<NamedProblem> conservative = {{"KG_defocusing", klein_gordon_case(0, 1.0)},
                                                  {"FPU", fpu_conservative_case(0, 0)},
                                                  {"gKdV", gkdv_case(0)},
                                                  {"Duffing", duffing_case(0)}};
  for (const auto& [name, problem] : conservative) {
    for (const MethodEntry& method : methods()) {
      if (!applies(method.name, problem)) continue;
      for (const BackendEntry& backend : backends_for(problem)) {
        Simulation simulation(problem, {.method = std::string(method.name), .backend = std::string(backend.name)});
        const EnergyReading start = simulation.energy();
        const double scale = std::abs(start.H) + simulation.state().shift;
        double drift = 0;
        for (int n = 0; n < repetitions(3200); ++n) {
          ASSERT_TRUE(simulation.step(1.0 / 64).solved());
          drift = worse(drift, std::abs(simulation.energy().modified - start.modified));
        }
        EXPECT_LE(drift, 1e-12 * scale) << name << " " << method.name << " " << backend.name;
      }
    }
  }
}

// Amplitudes at which every step is gross: the projection has far to go, along lines that are not rays where S has
// Casimirs.
TEST(EnergyLaw, HoldsForProjectedMethodsAtLargeAmplitudes) {
  Problem both = klein_gordon_case(0.001, 1.0);  // damping of u and v: Q is no quadratic form, and V is of u alone
  both.damping.rate_fields = {true, true};
  const std::vector<std::pair<NamedProblem, std::vector<double>>> list = {{{"gKdV", gkdv_case(0.0, -0.5)},
                                                                           {10, 100, 1e4}},
                                                                          {{"gKdV_damped", gkdv_case(0.1, -0.5)},
                                                                           {10, 100}},
                                                                          {{"KG_both", both}, {1, 5, 20}},
                                                                          {{"Duffing", duffing_case(0.0)}, {10, 100}}};
  int runs = 0;
  for (const auto& [named, amplitudes] : list) {
    ASSERT_TRUE(promise_energy_law(named.problem, 10).promised) << named.name;
    for (const double amplitude : amplitudes) {
      Problem p = named.problem;
      p.initial *= amplitude;
      for (const MethodEntry& method : methods()) {
        if (!method.projects() || !applies(method.name, p)) continue;
        for (const double h : {1.0 / 16, 0.25, 1.0, 2.5, 25.0}) {
          const LawRun result = run(p, method.name, "dense", h, 20 * h);
          EXPECT_LE(result.worst_increase, 1) << named.name << " " << amplitude << " " << method.name << " h = " << h;
          runs += result.steps;
        }
      }
    }
  }
  EXPECT_GT(runs, 3000);
}

// What exact solutions do, beside what a method promises.
TEST(EnergyLaw, KnowsWhereHNeverGrowsAndWhereItNeverChanges) {
  const auto promise = [](const Problem& p) { return promise_energy_law(p, 10); };
  const LawPromise damped = promise(klein_gordon_case(0.1, 1.0)), kept = promise(klein_gordon_case(0.0, 1.0)),
                   fed = promise(klein_gordon_case(-0.1, 1.0));
  EXPECT_TRUE(damped.never_grows && !damped.never_changes);
  EXPECT_TRUE(kept.never_grows && kept.never_changes);
  EXPECT_TRUE(!fed.never_grows && !fed.never_changes);
  SimulationOptions without_law = {.method = "egc4"};
  without_law.method_options.law = EnergyLaw::none;
  const Simulation unprojected(klein_gordon_case(0.0, 1.0), without_law);
  const LawPromise given_up = promise_energy_law(unprojected, 10);
  EXPECT_TRUE(!given_up.promised && given_up.never_grows && given_up.never_changes);
}

TEST(EnergyLaw, NamesEverythingThatStandsAgainstIt) {
  Problem p = klein_gordon_case(-0.1, 1.0);
  p.forces = {nullptr, formula_space_rate(compile_formula("0.3*cos(t)", {"t", "x"}), 1, false)->on(p.grid)};
  EXPECT_THAT(promise_energy_law(p, 10).reason,
              testing::AllOf(testing::HasSubstr("an external force does work"),
                             testing::HasSubstr("and the rate -0.1 is negative at t = 0")));
}

// The law is not a property of round-off: these must rise, or the tests above could not fail.
TEST(EnergyLaw, IsSeenToFailWhereItsHypothesesFail) {
  const Problem fed = klein_gordon_case(-0.1, 1.0);  // negative damping
  EXPECT_FALSE(promise_energy_law(fed, 50).promised);
  EXPECT_GT(run(fed, "seisav", "dense", 1.0 / 64, 20).worst_increase, 1e6);
  EXPECT_GT(run(fed, "seavf", "modal", 1.0 / 64, 20).worst_increase, 1e6);
}

TEST(EnergyLaw, IsNotPromisedForFocusingGkdvWhereTheExactEnergyRises) {
  const Problem p = gkdv_case(0.5, 1.0, 3.0);
  const LawPromise promise = promise_energy_law(p, 10);
  EXPECT_FALSE(promise.promised);
  EXPECT_NE(promise.reason.find("energy-compatible"), std::string::npos) << promise.reason;
  EXPECT_GT(run(p, "seidm", "modal", 1.0 / 256, 0.1).worst_increase, 1e3);
  EXPECT_TRUE(promise_energy_law(gkdv_case(0.5, -1.0), 10).promised);
}

TEST(EnergyLaw, IsPromisedForARateInSpaceWhereMIsTheIdentityOnTheDampedField) {
  const auto rate = [](const std::string& text) {
    return formula_space_rate(compile_formula(text, {"t", "x"}), 1, false);
  };
  EXPECT_TRUE(promise_energy_law(klein_gordon({.alpha = 1.0, .gamma = rate("x")}), 10).promised);
  EXPECT_TRUE(promise_energy_law(chain({.mass = 3.0, .neighbour_damping = 0.1, .gamma = rate("x")}), 10).promised);

  const LawPromise negative = promise_energy_law(klein_gordon({.alpha = 1.0, .gamma = rate("3 - x - t")}), 10);
  EXPECT_FALSE(negative.promised);
  EXPECT_NE(negative.reason.find("negative at t = 1.0"), std::string::npos) << negative.reason;
  EXPECT_NE(negative.reason.find("x = 2"), std::string::npos) << negative.reason;

  const Problem p = nls({.kappa = -1.0, .gamma = rate("1 + sin(x)")});
  const LawPromise promise = promise_energy_law(p, 10);
  EXPECT_FALSE(promise.promised);
  EXPECT_NE(promise.reason.find("not a multiple of the identity on the damped field p"), std::string::npos)
      << promise.reason;
  // and rightly: between points with different damping a gradient grows, H of a constant field with it
  Problem level =
      nls({.grid = {.points = {32}, .length = {4.0}}, .kappa = 0.0, .gamma = rate("40*exp(-40*(x - 2)^2)")});
  level.initial.setOnes();
  EXPECT_GT(run(level, "seisav", "modal", 1.0 / 64, 0.1).worst_increase, 1e6);
}

TEST(EnergyLaw, HoldsForTheModifiedEnergyWhereTheShiftLeavesNoMargin) {
  const Problem p = klein_gordon_case(0.1, -1.0);
  MethodOptions tight{.C = 0.1116};  // V(z₀) + C = 3e-5
  const LawRun result = run(p, "seisav", "modal", 1.0 / 64, 50, tight);
  EXPECT_TRUE(result.finished);
  EXPECT_LE(result.worst_increase, 1);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
