// auxiliary = "relaxed": the modified energy stays that of the problem where something dissipates, and never rises.
#include <test/support/cases.hpp>
#include <test/support/error_of.hpp>

#include <seiche/config/custom/custom_problem.hpp>
#include <seiche/problem/gradient_flow/phase_separation.hpp>
#include <seiche/simulation/certificate.hpp>
#include <seiche/simulation/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

// Cahn and Hilliard's equation on a square, and Allen and Cahn's: S = Δ and S = −1.
Problem gradient_flow(const char* S, std::vector<long> points = {24, 20}) {
  return custom_problem({.fields = {"u"},
                         .grid = GridOptions{.points = std::move(points)},
                         .H = "0.002*(u_x^2 + u_y^2)/2 + (u^2 - 1)^2/4",
                         .S = {{S}},
                         .initial = {{"u", "0.6*cos(2*pi*x)*cos(2*pi*y) + 0.1*sin(4*pi*x)"}}});
}

SimulationOptions with(AuxiliaryMode mode, std::string method = "seisav") {
  SimulationOptions options{.method = std::move(method)};
  options.method_options.auxiliary = mode;
  return options;
}

// The largest rise of H̃ in a step over its round-off, and the largest |H̃ − H| over the energy at the start.
struct Course {
  double rise = 0.0, parting = 0.0;
};
Course course(const Problem& problem, const SimulationOptions& options, double h, int steps) {
  Simulation simulation(problem, options);
  Course course;
  EnergyReading before = simulation.energy();
  const double scale = before.size;
  for (int n = 0; n < steps; ++n) {
    EXPECT_TRUE(simulation.step(h).solved()) << h;
    const EnergyReading after = simulation.energy();
    course.rise = std::max(course.rise, (after.modified - before.modified) / after.modified_round_off);
    course.parting = std::max(course.parting, std::abs(after.modified - after.H) / scale);
    before = after;
  }
  return course;
}

TEST(Relaxed, TheModifiedEnergyNeverRisesAtAnyStep) {
  std::vector<NamedProblem> problems = {{"CH", gradient_flow("laplacian")}, {"AC", gradient_flow("-1")}};
  for (const NamedProblem& c : grid_cases())
    if (c.problem.has_damping()) problems.push_back(c);
  for (const NamedProblem& c : problems)
    for (const MethodEntry& method : methods()) {
      if (!method.kind.takes_C || !applies(method.name, c.problem)) continue;
      const SimulationOptions options = with(AuxiliaryMode::relaxed, std::string(method.name));
      if (!promise_energy_law(Simulation(c.problem, options), 1).promised) continue;
      for (const double h : {1e-6, 1e-3, 0.05, 1.0, 300.0})
        EXPECT_LE(course(c.problem, options, h, 8).rise, 1) << c.name << " " << method.name << " " << h;
    }
}

TEST(Relaxed, KeepsTheModifiedEnergyAtThatOfTheProblemWhereStepsDissipate) {
  for (const char* S : {"laplacian", "-1"})
    for (const double h : {1e-4, 1e-3}) {
      const Problem problem = gradient_flow(S);
      const double transported = course(problem, with(AuxiliaryMode::transport), h, 40).parting;
      const double relaxed = course(problem, with(AuxiliaryMode::relaxed), h, 40).parting;
      EXPECT_LT(relaxed, 0.05 * transported) << S << " " << h;
      EXPECT_EQ(course(problem, {.method = "seisav"}, h, 40).parting, relaxed) << "auto, of a gradient flow";
    }
}

TEST(Relaxed, IsWhatItWasWhereNothingDissipates) {
  const Problem problem = klein_gordon_case();
  Problem undamped = problem;
  undamped.damping = LinearDamping{.constant = BlockStencil(2)};
  Simulation one(undamped, with(AuxiliaryMode::transport)), other(undamped, {.method = "seisav"});
  for (int n = 0; n < 20; ++n) {
    ASSERT_TRUE(one.step(0.05).solved() && other.step(0.05).solved());
    EXPECT_EQ(one.state().z, other.state().z);
  }
}

TEST(Relaxed, BelongsToTheSavFamily) {
  EXPECT_THAT(error_of([] { Simulation(klein_gordon_case(), with(AuxiliaryMode::relaxed, "seilm")); }),
              testing::HasSubstr("auxiliary = \"relaxed\" belongs to the sav family"));
}

TEST(Relaxed, IsNamedByTheCertificateOfGradientFlows) {
  using testing::HasSubstr;
  using testing::Not;
  const auto theorem = [](const Problem& p, AuxiliaryMode mode) {
    MethodOptions options;
    options.auxiliary = mode;
    return certify(p, {.method = "seisav", .method_options = options}).theorem;
  };
  const Problem flow = cahn_hilliard({.grid = {.points = {12}}, .kappa = 0.01});
  EXPECT_THAT(theorem(flow, AuxiliaryMode::automatic), HasSubstr("r² moves towards V + C"));
  EXPECT_THAT(theorem(flow, AuxiliaryMode::transport), Not(HasSubstr("r² moves")));
  EXPECT_THAT(theorem(klein_gordon_case(), AuxiliaryMode::automatic), Not(HasSubstr("r² moves")));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
