// The equations of collocation in gradient flows, where they begin with little and where they have no solution.
#include <seiche/config/case/case_file.hpp>
#include <seiche/problem/gradient_flow/phase_separation.hpp>
#include <seiche/simulation/solve.hpp>

#include <gtest/gtest.h>

#include <string>

namespace seiche::test {
namespace TEST_FILE {

// u' = Δu − ∇V + f from u = 0
Problem from_rest(const std::string& keys) {
  const std::string text =
      "[problem]\nname = \"custom\"\nfields = [\"u\"]\npoints = 24\nlength = 20.0\ndiscretisation = \"spectral\"\n"
      "S = \"-1\"\nM = \"k^2\"\ninitial = { u = \"0\" }\n" +
      keys;
  return make_problem(parse_case(text, "rest.toml"));
}

// What is small is judged beside what forces give, and not beside a state of zeros.
TEST(CollocationEquations, AreSolvedFromRestUnderAForceAndOnASlope) {
  for (const Problem& p : {from_rest("V = \"3*(cosh(u) - 1) + u^3/3\"\nforce = \"50*exp(-(x - 10)^2)*cos(3*x)\"\n"),
                           from_rest("V = \"5*(u - 0.3)^2*(u - 0.7)^2\"\n")}) {
    const Vector exact = solve(p, {.method = "egc6", .h = 0.002, .t_end = 1}).last();
    for (const char* method : {"egc2", "egc4", "egc6"}) {
      const Solution s = solve(p, {.method = method, .h = 0.05, .t_end = 1});
      ASSERT_TRUE(s.success()) << method << s.report.message;
      EXPECT_EQ(s.report.halved + s.report.replaced.count, 0) << method << s.report.message;
      EXPECT_LE((s.last() - exact).lpNorm<Eigen::Infinity>(), 2e-3) << method;
    }
  }
}

// What stands for a step that has no solution keeps the law, and the run says that this is nothing to rely on.
TEST(CollocationEquations, LeaveTheLawWhereTheyHaveNoSolution) {
  const Problem p = cahn_hilliard({.grid = {.points = {32, 32}, .length = {1.0}, .boundary = {Boundary::neumann}}});
  for (const char* method : {"egc2", "egc4", "egc6", "egc8"}) {
    for (const double h : {2.0, 10.0}) {
      const Solution s = solve(p, {.method = method, .h = h, .t_end = 4 * h});
      EXPECT_EQ(s.report.steps, 4) << method << ' ' << h << s.report.message;
      EXPECT_EQ(s.report.law, LawVerdict::holds) << method << ' ' << h << s.report.message;
      EXPECT_GT(s.report.halved + s.report.replaced.count, 0) << method << ' ' << h;
    }
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
