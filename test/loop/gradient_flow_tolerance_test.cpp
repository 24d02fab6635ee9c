// Tolerances on gradient flows, where fast components forget errors and the solution has its own time.
#include <seiche/config/custom/custom_problem.hpp>
#include <seiche/config/data/rate_formulas.hpp>
#include <seiche/problem/gradient_flow/pattern_formation.hpp>
#include <seiche/problem/gradient_flow/phase_separation.hpp>
#include <seiche/simulation/solve.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace seiche {
namespace TEST_FILE {

struct Flow {
  std::string name;
  Problem problem;
  double t_end;
  double reference_h;
  int most_steps;  // at a tolerance of 0.01
};

std::vector<Flow> flows() {
  const auto grid = [](Index n, double length) {
    return GridOptions{.points = {n, n}, .length = {length}, .discretisation = Discretisation::spectral};
  };
  return {
      // Separation begins within 4κ = 0.002, and hρ of the reference is 2000 for the fastest mode.
      {"Cahn–Hilliard", cahn_hilliard({.grid = grid(48, 1), .kappa = 5e-4, .amplitude = 0.3}), 0.1, 2e-5, 4000},
      {"Allen–Cahn", allen_cahn({.grid = grid(32, 1), .kappa = 1e-3, .amplitude = 0.9}), 20, 0.02, 1000},
      {"Swift–Hohenberg", swift_hohenberg({.grid = grid(32, 25), .amplitude = 0.5}), 60, 0.1, 1000},
      {"phase-field crystal", phase_field_crystal({.grid = grid(32, 25), .r = 0.25, .mean = -0.25}), 60, 0.1, 1000},
  };
}

// The spinodal decomposition multiplies errors at its beginning by about ten.
TEST(GradientFlowToleranceSlow, SaysWhatTheErrorWillBeOverFourDecades) {
  for (const Flow& flow : flows()) {
    const Vector exact = solve(flow.problem, {.method = "egc6", .h = flow.reference_h, .t_end = flow.t_end}).last();
    for (const char* method : {"seisav", "seilm", "egc4", "egc6", "etdrk4"}) {
      for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4}) {
        const Solution s = solve(flow.problem, {.method = method, .tolerance = tolerance, .t_end = flow.t_end});
        ASSERT_TRUE(s.success()) << s.report.message;
        EXPECT_LE((s.last() - exact).lpNorm<Eigen::Infinity>(), 20 * tolerance)
            << flow.name << ", " << method << ", " << tolerance << ": " << s.report.message;
        EXPECT_EQ(s.report.law, LawVerdict::holds) << flow.name << ", " << method;
        if (tolerance == 1e-2) {
          EXPECT_LE(s.report.steps, flow.most_steps) << flow.name << ", " << method << ": " << s.report.message;
        }
      }
    }
  }
}

// The equations of collocation are solved where forces damp many times over in a step. By an explicit force steps would
// be 20 and 3 times as many.
TEST(GradientFlowTolerance, CollocationTakesStepsThatNoExplicitForceCouldTake) {
  const GridOptions grid{.points = {48, 48}, .length = {1}, .discretisation = Discretisation::fd2};
  PhaseSeparation options{.grid = grid, .kappa = 1e-3, .amplitude = 0.3};
  const auto steps = [&](const char* method, double t_end) {
    const Solution s = solve(cahn_hilliard(options), {.method = method, .tolerance = 1e-3, .t_end = t_end});
    EXPECT_TRUE(s.success()) << s.report.message;
    EXPECT_EQ(s.report.law, LawVerdict::holds);
    return s.report.steps;
  };
  options.mobility_of_u = compile_state_function("1 + 0.5*u", "u");
  EXPECT_LE(steps("egc4", 0.05), 200);
  options.mobility_of_u = nullptr;
  EXPECT_LE(3 * steps("egc4", 5), steps("etdrk4", 5));
}

// A hundred times as long. Phases part within some hundred units of time, then interfaces hardly move, and with the
// curvature of the wells in M nothing keeps steps short. What seisav errs by, of order two, keeps its steps near four.
TEST(GradientFlowTolerance, StepsGrowWithTheSolutionsOwnTime) {
  const Problem p = allen_cahn(
      {.grid = {.points = {64}, .discretisation = Discretisation::spectral}, .kappa = 2e-3, .stabilisation = 2});
  for (const auto& [method, most] : {std::pair("seisav", 20), {"egc4", 12}, {"etdrk4", 4}}) {
    const auto steps = [&, name = method](double t_end) {
      return solve(p, {.method = name, .tolerance = 1e-3, .t_end = t_end}).report.steps;
    };
    EXPECT_LT(steps(10000), most * steps(100)) << method;
  }
}

// ż = z − z³ as a flow of S = 1 and of S = −1: a linear part that lets errors grow forgets none.
TEST(GradientFlowTolerance, HoldsWhereTheLinearPartGrows) {
  for (const bool is_upward : {true, false}) {
    const Problem p =
        custom_problem({.fields = {"a", "b"},
                        .H = is_upward ? "(a^2 + b^2)/2 - (a^4 + b^4)/4" : "(a^4 + b^4)/4 - (a^2 + b^2)/2",
                        .S = is_upward ? FormulaTable{{"1", "0"}, {"0", "1"}} : FormulaTable{{"-1", "0"}, {"0", "-1"}},
                        .initial = {{"a", "0.1"}, {"b", "-0.3"}}});
    // a(t) = a₀eᵗ/√(1 + a₀²(e^{2t} − 1))
    const auto exact = [](double a, double t) { return a * std::exp(t) / std::sqrt(1 + a * a * std::expm1(2 * t)); };
    for (const char* method : {"seavf", "egc4", "etdrk4"})
      for (const double tolerance : {1e-3, 1e-6}) {
        const Solution s = solve(p, {.method = method, .tolerance = tolerance, .t_end = 3});
        ASSERT_TRUE(s.success()) << s.report.message;
        EXPECT_NEAR(s.last()[0], exact(0.1, 3), 20 * tolerance) << method << " " << is_upward;
        EXPECT_NEAR(s.last()[1], exact(-0.3, 3), 20 * tolerance) << method << " " << is_upward;
      }
  }
}

}  // namespace TEST_FILE
}  // namespace seiche
