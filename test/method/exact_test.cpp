// Identities and exact solutions.
#include <test/support/cases.hpp>
#include <test/support/matrices.hpp>
#include <test/support/repetitions.hpp>
#include <test/support/worst.hpp>

#include <seiche/core/base/error.hpp>
#include <seiche/potential/polynomials.hpp>
#include <seiche/simulation/simulation.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

namespace seiche::test {
namespace TEST_FILE {

TEST(Exact, ExponentialMethodsSolveLinearGkdvExactly) {
  constexpr int steps = repetitions(640);
  const Problem p = gkdv_case(0.5, 0.0);
  const Matrix L = p.S.matrix(p.grid) * p.M.matrix(p.grid) - 0.5 * Matrix::Identity(20, 20);
  const Vector expected = exponential_by_extended_series(L * (steps / 64.0)) * p.initial;
  for (const MethodEntry& method : methods()) {
    if (method.propagator != PropagatorKind::exponential || !applies(method.name, p)) continue;
    for (const BackendEntry& backend : backends()) {
      Simulation simulation(p, {.method = std::string(method.name), .backend = std::string(backend.name)});
      for (int n = 0; n < steps; ++n) ASSERT_TRUE(simulation.step(1.0 / 64).solved());
      EXPECT_LE(largest(simulation.physical() - expected), 1e-14) << method.name << backend.name;
    }
  }
}

TEST(Exact, GkdvLosesItsTwoLinearInvariantsAtTheRateOfTheDamping) {
  constexpr int steps = repetitions(50 * 64);
  for (const MethodEntry& method : methods()) {
    for (const double mu : {0.5, 0.1}) {
      const Problem p = gkdv_case(mu, 1.0);
      if (!applies(method.name, p)) continue;
      for (const BackendEntry& backend : backends()) {
        Simulation simulation(p, {.method = std::string(method.name), .backend = std::string(backend.name)});
        const auto sums = [](const Vector& z) {
          double sum = 0;
          double alternating = 0;
          for (Index j = 0; j < z.size(); ++j) {
            sum += z[j];
            alternating += j % 2 == 0 ? z[j] : -z[j];
          }
          return std::pair(sum, alternating);
        };
        const auto start = sums(p.initial);
        for (int n = 0; n < steps; ++n) ASSERT_TRUE(simulation.step(1.0 / 64).solved());
        const auto end = sums(simulation.physical());
        const double left = std::exp(-mu * steps / 64);
        EXPECT_NEAR(end.first, start.first * left, 1e-12) << method.name << backend.name;
        EXPECT_NEAR(end.second, start.second * left, 1e-12) << method.name << backend.name;
      }
    }
  }
}

TEST(Exact, WithOneDegreeOfFreedomTheMultiplierIsTheAveragedVectorField) {
  const Problem p = duffing_case(0.0);
  for (const auto& [lm, avf] : {std::pair("lm", "avf"), std::pair("eilm", "eavf")}) {
    SimulationOptions options{.method = lm};
    options.method_options.scalar_solver = ScalarSolver::newton;
    Simulation multiplier(p, options);
    Simulation averaged(p, {.method = avf});
    int unresolved = 0;
    for (int n = 0; n < 640; ++n) {
      unresolved += multiplier.step(1.0 / 64).unresolved;
      ASSERT_TRUE(averaged.step(1.0 / 64).solved());
      ASSERT_LE(largest(multiplier.physical() - averaged.physical()), 1e-11) << lm << " step " << n;
    }
    EXPECT_EQ(unresolved, 0);
  }
}

TEST(Exact, WholeAndStrangCoincideWithoutDamping) {
  const Problem p = klein_gordon_case(0.0, 1.0);
  for (const auto& [whole, strang] :
       {std::pair("avf", "savf"), std::pair("sav", "ssav"), std::pair("lm", "slm"), std::pair("eavf", "seavf"),
        std::pair("eisav", "seisav"), std::pair("eilm", "seilm")}) {
    Simulation a(p, {.method = whole});
    Simulation b(p, {.method = strang});
    for (int n = 0; n < 64; ++n) {
      ASSERT_TRUE(a.step(1.0 / 64).solved());
      ASSERT_TRUE(b.step(1.0 / 64).solved());
    }
    EXPECT_EQ((a.physical() - b.physical()).norm(), 0) << whole;
  }
}

TEST(Exact, AStateAtEquilibriumStaysThere) {
  Problem p = duffing_case(0.1);
  p.initial.setZero();
  for (const MethodEntry& method : methods()) {
    Simulation simulation(p, {.method = std::string(method.name)});
    for (int n = 0; n < 10; ++n) ASSERT_TRUE(simulation.step(0.5).solved()) << method.name;
    EXPECT_EQ(simulation.physical().norm(), 0) << method.name;
  }
}

TEST(Exact, ASolutionThatDecaysBelowTheSmallestNumberIsFollowedToTheEnd) {
  for (const auto& [name, problem, h] :
       {std::tuple("gkdv", gkdv_case(0.5), 1.0), std::tuple("fpu", fpu_dissipative_case(), 3.0)}) {
    for (const MethodEntry& method : methods()) {
      if (!applies(method.name, problem)) continue;
      Simulation simulation(problem, {.method = std::string(method.name)});
      for (int n = 0; n < 2000; ++n) {
        const StepReport report = simulation.step(h);
        ASSERT_TRUE(report.solved()) << name << " " << method.name << " step " << n << ": " << report.message;
      }
      if (method.propagator == PropagatorKind::exponential) {  // Crank–Nicolson hardly damps what it does not resolve
        EXPECT_LE(simulation.physical().norm(), 1e-100) << name << " " << method.name;
      }
    }
  }
}

TEST(Exact, AFailedStepLeavesTheStateAsItWas) {
  Problem p = klein_gordon_case(0.0, -1.0);
  p.initial *= 1e70;  // V overflows within the step
  for (const MethodEntry& method : methods()) {
    Simulation simulation(p, {.method = std::string(method.name)});
    const Vector before = simulation.state().z;
    const StepReport report = simulation.step(1.0);
    // goes on with e^{hL}z, moved to where H is no larger, and says so
    if (method.projects()) {
      EXPECT_TRUE(report.solved() && report.fallbacks > 0) << method.name;
      continue;
    }
    EXPECT_FALSE(report.solved()) << method.name;
    EXPECT_FALSE(report.message.empty()) << method.name;
    EXPECT_EQ(simulation.state().z, before) << method.name;
    EXPECT_EQ(simulation.state().n, 0);
  }
}

TEST(Exact, AnInitialStateWithoutFiniteEnergyIsRefused) {
  Problem p = klein_gordon_case(0.0, -1.0);
  p.initial *= 1e100;
  EXPECT_THROW(Simulation(p, {.method = "seisav"}), Error);
  EXPECT_THROW(Simulation(p, {.method = "seavf"}), Error);
}

// V = q/10 + q⁴/4: the origin is no equilibrium, and a step from it leaves |z| = 0 behind.
TEST(Exact, AStateThatStartsAtTheOriginLeavesItWhereVPulls) {
  Problem p = duffing_case(0.1);
  p.potential = nodal_polynomial({0, 0.1, 0, 0, 0.25});
  p.initial.setZero();
  Simulation expected(p, {.method = "seavf", .backend = "dense"});
  for (int n = 0; n < 1024; ++n) ASSERT_TRUE(expected.step(1.0 / 1024).solved());
  for (const MethodEntry& method : methods()) {
    if (!applies(method.name, p)) continue;
    for (const double start : {0.0, 1e-6}) {
      p.initial.setConstant(start);
      Simulation simulation(p, {.method = std::string(method.name), .backend = "dense"});
      for (int n = 0; n < 64; ++n) ASSERT_TRUE(simulation.step(1.0 / 64).solved());
      EXPECT_LE((simulation.physical() - expected.physical()).lpNorm<Eigen::Infinity>(), 1e-3) << method.name;
    }
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
