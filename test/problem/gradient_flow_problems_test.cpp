// What is known of phases that part and of patterns.
#include <seiche/method/methods.hpp>
#include <seiche/problem/gradient_flow/pattern_formation.hpp>
#include <seiche/problem/gradient_flow/phase_separation.hpp>
#include <seiche/simulation/simulation.hpp>
#include <test/support/cases.hpp>
#include <test/support/error_of.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace seiche::test {
namespace TEST_FILE {

Vector after(const Problem& problem, const std::string& method, double h, int steps) {
  Simulation simulation(problem, {.method = method});
  for (int n = 0; n < steps; ++n) EXPECT_TRUE(simulation.step(h).solved());
  return simulation.physical();
}

// An interface moves by its curvature, dR/dt = −mκ/R, as far as it is thin.
TEST(AllenCahn, ADropShrinksByItsCurvature) {
  const PhaseSeparation options{.grid = {.points = {64, 64},
                                         .length = {1.0},
                                         .discretisation = Discretisation::spectral},
                                .kappa = 4e-4,
                                .mobility = 2.0,
                                .initial = PhaseSeparation::Initial::drop};
  const Problem p = allen_cahn(options);
  const auto radius_squared = [](const Vector& u) { return (u.mean() + 1) / 2 / std::numbers::pi; };
  const double early = radius_squared(after(p, "seisav", 0.05, 100)),
               late = radius_squared(after(p, "seisav", 0.05, 500));
  EXPECT_NEAR(early - late, 2 * options.mobility * options.kappa * 20, 0.05 * (early - late));
  EXPECT_NEAR(late, 0.25 * 0.25 - 2 * options.mobility * options.kappa * 25, 2e-3);
}

TEST(CahnHilliard, KeepsItsMeanByEveryKindOfMethod) {
  using enum Boundary;
  for (const Boundary end : {periodic, neumann})
    for (const Discretisation d : {Discretisation::fd2, Discretisation::spectral}) {
      const Problem p =
          cahn_hilliard({.grid = {.points = {12, 10}, .length = {1.0}, .boundary = {end}, .discretisation = d},
                         .kappa = 5e-3,
                         .mean = 0.3});
      for (const char* method : {"seisav", "seilm", "egc4", "etdrk4", "ssav"})
        EXPECT_NEAR(after(p, method, 1e-3, 50).mean(), p.initial.mean(), 1e-13) << method;
    }
}

// Small waves grow as e^{(r − (q² − k²)²)t}, of what is conserved k² times as fast.
TEST(PatternFormation, SmallWavesGrowAsTheirEquationsSay) {
  constexpr double r = 0.3, g = 0.5, q = 1.2;
  for (const bool is_conserved : {false, true}) {
    for (const int n : {3, 4, 5, 6}) {
      const double length = 8 * std::numbers::pi, k = n / 4.0;
      PatternFormation options{.grid = {.points = {64}, .length = {length}, .discretisation = Discretisation::spectral},
                               .r = r,
                               .g = g,
                               .q = q,
                               .mobility = 0.5};
      Problem p = is_conserved ? phase_field_crystal(options) : swift_hohenberg(options);
      for (Index i = 0; i < 64; ++i) p.initial[i] = 1e-7 * std::cos(k * p.grid.coordinate(i, 0));
      const double rate = 0.5 * (is_conserved ? k * k : 1) * (r - square(q * q - k * k));
      const Vector u = after(p, "egc4", 0.05, 100);
      EXPECT_NEAR(u.lpNorm<Eigen::Infinity>() / p.initial.lpNorm<Eigen::Infinity>(), std::exp(5 * rate),
                  1e-5 * std::exp(5 * rate))
          << is_conserved << " " << k;
    }
  }
}

// ½βu² is part of H wherever it stands.
TEST(PhaseSeparation, StabilisationChangesNeitherTheEnergyNorTheSolution) {
  PhaseSeparation options{.grid = {.points = {16, 16}}, .kappa = 2e-3, .low = -0.5, .high = 1.5};
  const Problem plain = allen_cahn(options);
  options.stabilisation = 3;
  const Problem stabilised = allen_cahn(options);
  EXPECT_NEAR(Simulation(plain).energy().H, Simulation(stabilised).energy().H, 1e-12 * Simulation(plain).energy().H);
  const Vector a = after(plain, "egc6", 0.01, 100), b = after(stabilised, "egc6", 0.01, 100);
  EXPECT_LT((a - b).lpNorm<Eigen::Infinity>(), 1e-9);
}

// The energy that each method keeps a law for, and H beside it where that is another: on a rough state, far from rest.
TEST(GradientFlowProblems, KeepTheLawFromStepsOfAMillionthToSuchOfThreeHundred) {
  for (const NamedProblem& c : gradient_flow_cases()) {
    Problem problem = c.problem;
    for (Index j = 0; j < problem.size(); ++j) problem.initial[j] += 0.4 * std::sin(2.3 * static_cast<double>(j + 1));
    for (const MethodEntry& method : methods()) {
      if (!applies(method.name, problem)) continue;
      for (const double h : {1e-6, 1e-4, 1e-2, 1.0, 30.0, 300.0}) {
        Simulation s(problem, {.method = std::string(method.name)});
        EnergyReading before = s.energy();
        for (int i = 0; i < 5; ++i) {
          if (!s.step(h).solved()) {  // a nonlinear equation without a solution: the state is as it was
            EXPECT_TRUE(h >= 30 && (method.kind.closure == "avf" || method.kind.closure == "lm"))
                << c.name << ' ' << method.name << ' ' << h;
            break;
          }
          const EnergyReading now = s.energy();
          EXPECT_LE(now.modified, before.modified + now.modified_round_off) << c.name << ' ' << method.name << ' ' << h;
          before = now;
        }
      }
    }
  }
}

TEST(GradientFlowProblems, RefuseWhatIsNoFlow) {
  using testing::HasSubstr;
  EXPECT_THAT(error_of([] { allen_cahn({.mobility = -1}); }), HasSubstr("mobility = -1 must be > 0"));
  EXPECT_THAT(error_of([] { cahn_hilliard({.kappa = 0}); }), HasSubstr("kappa = 0 must be > 0"));
  EXPECT_THAT(error_of([] { cahn_hilliard({.low = 1, .high = 1}); }), HasSubstr("must differ"));
  EXPECT_THAT(error_of([] { swift_hohenberg({.mobility = 0}); }), HasSubstr("mobility = 0 must be > 0"));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
