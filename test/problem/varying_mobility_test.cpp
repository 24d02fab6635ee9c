// Mobilities that follow the field, against operators with a constant one, and their law.
#include <test/support/cases.hpp>
#include <test/support/error_of.hpp>

#include <seiche/config/data/rate_formulas.hpp>
#include <seiche/problem/gradient_flow/phase_separation.hpp>
#include <seiche/problem/gradient_flow/varying_mobility.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/simulation/solve.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

using Matrix = Eigen::MatrixXd;
using testing::HasSubstr;

struct Kind {
  Discretisation discretisation;
  std::vector<Boundary> ends;
  std::vector<Index> points;
};

const std::vector<Kind>& kinds() {
  using enum Boundary;
  using enum Discretisation;
  static const std::vector<Kind> all = {{fd2, {periodic}, {9}},
                                        {fd2, {neumann}, {7}},
                                        {fd2, {dirichlet}, {8}},
                                        {fd2, {periodic, neumann}, {5, 4}},
                                        {fd2, {dirichlet, neumann, periodic}, {3, 4, 5}},
                                        {spectral, {periodic}, {9}},
                                        {spectral, {periodic}, {5, 7}}};
  return all;
}

PhaseSeparation with_mobility(const std::string& formula, const Kind& kind) {
  PhaseSeparation options;
  options.grid = {.points = kind.points, .length = {1.3}, .boundary = kind.ends, .discretisation = kind.discretisation};
  options.mobility_of_u = compile_state_function(formula, "u");
  return options;
}

// S + S'(z) as a matrix.
Matrix structure_at(const Problem& problem, const Vector& z) {
  const System system = find_backend("dense").system(problem, {});
  const Index n = z.size();
  Matrix all(n, n);
  Vector column(n), linear(n);
  for (Index j = 0; j < n; ++j) {
    const Vector unit = Vector::Unit(n, j);
    system.structure->apply(z, unit, column);
    system.linear->apply_S(unit, linear);
    all.col(j) = column + linear;
  }
  return all;
}

TEST(VaryingMobility, OfAConstantStateIsAConstantMobility) {
  for (const Kind& kind : kinds()) {
    for (const auto make : {allen_cahn, cahn_hilliard}) {
      const Problem varying = make(with_mobility("1 + u/2", kind));
      PhaseSeparation constant = with_mobility("1", kind);
      constant.mobility_of_u = nullptr;
      constant.mobility = 1.25;
      const Matrix expected = make(constant).S.matrix(varying.grid);
      Matrix found = structure_at(varying, Vector::Constant(varying.size(), 0.5));
      // Beyond a Dirichlet end u is 0, and M there is another.
      if (kind.ends.front() == Boundary::dirichlet && make == cahn_hilliard)
        found = structure_at(make(with_mobility("1.25 + 0*u", kind)), Vector::Constant(varying.size(), 0.5));
      EXPECT_LE((found - expected).norm(), 1e-12 * expected.norm());
    }
  }
}

TEST(VaryingMobility, IsSymmetricDissipatesAndKeepsTheMeanForEveryState) {
  for (const Kind& kind : kinds()) {
    for (const char* formula : {"1 - u^2/2", "0.2 + exp(u)", "1 - 4*u^2"}) {  // the last is cut off at 0
      const Problem problem = cahn_hilliard(with_mobility(formula, kind));
      Vector z(problem.size());
      for (Index j = 0; j < z.size(); ++j) z[j] = std::sin(1.7 * static_cast<double>(j + 1));
      const Matrix S = structure_at(problem, z);
      EXPECT_LE((S - S.transpose()).norm(), 1e-13 * S.norm());
      EXPECT_LE(Eigen::SelfAdjointEigenSolver<Matrix>(S).eigenvalues().maxCoeff(), 1e-13 * S.norm());
      EXPECT_GT(S.norm(), 1);
      if (kind.ends.front() == Boundary::dirichlet) continue;
      EXPECT_LE(S.colwise().sum().norm(), 1e-12 * S.norm());
    }
  }
}

TEST(VaryingMobility, KeepsTheLawAtEveryStepSizeWhateverTheMobility) {
  for (const char* formula : {"1 + u/2", "1 - 0.9*u^2"}) {
    for (const Kind& kind : kinds()) {
      for (const std::string method : {"egc2", "egc4", "egc6", "seimp", "etdrk4"}) {
        for (const double h : {1e-6, 1e-3, 1.0, 300.0}) {
          PhaseSeparation options = with_mobility(formula, kind);
          options.kappa = 1e-2;
          options.amplitude = 0.8;
          Simulation s(cahn_hilliard(options), {.method = method});
          double H = s.energy().H;
          for (int i = 0; i < 4; ++i) {
            if (!s.step(h).solved()) break;  // says that it found no such state, and leaves the last one
            const EnergyReading now = s.energy();
            EXPECT_LE(now.H, H + now.round_off) << method << ' ' << formula << ' ' << h;
            H = now.H;
          }
        }
      }
    }
  }
}

// κ(M(u) − M₀)ΔΔu damps some thousand times over in one step of 10⁻³.
TEST(VaryingMobility, TakesLongStepsByCollocation) {
  const Kind square{Discretisation::fd2, {Boundary::neumann}, {32, 32}};
  PhaseSeparation options = with_mobility("1 + 0.5*u", square);
  options.kappa = 1e-3;
  const Problem problem = cahn_hilliard(options);
  const auto end = [&](const char* method, double h, int halved) {
    const Solution s = solve(problem, {.method = method, .h = h, .t_end = 0.02});
    EXPECT_TRUE(s.success()) << s.report.message;
    EXPECT_EQ(s.report.law, LawVerdict::holds) << s.report.message;
    EXPECT_EQ(s.report.halved, halved) << method << " " << h << " " << s.report.message;
    EXPECT_EQ(s.report.replaced.count, 0);
    return Vector(s.last());
  };
  const Vector exact = end("egc6", 2e-5, 0);
  EXPECT_LE((end("egc4", 1e-3, 0) - exact).lpNorm<Eigen::Infinity>(), 1e-3);
  EXPECT_LE((end("egc2", 1e-3, 0) - exact).lpNorm<Eigen::Infinity>(), 3e-2);
  EXPECT_LE((end("egc4", 2e-2, 1) - exact).lpNorm<Eigen::Infinity>(), 0.1) << "in parts";
}

TEST(VaryingMobility, RefusesWhatItCannotBe) {
  const Kind line{Discretisation::fd2, {Boundary::periodic}, {9}};
  const auto start = [&](const std::string& formula) {
    return error_of([&] { Simulation(cahn_hilliard(with_mobility(formula, line)), {.method = "egc4"}); });
  };
  EXPECT_THAT(start("1 - 9*u^2"), HasSubstr("in the initial state the mobility 1 - 9*u^2 is -"));
  EXPECT_THAT(start("-1 + 0*u"), HasSubstr("nowhere > 0"));
  EXPECT_THAT(start("log(u)"), HasSubstr("the mobility log(u) is"));
  const Kind cosine{Discretisation::spectral, {Boundary::neumann}, {9}};
  EXPECT_THAT(error_of([&] { cahn_hilliard(with_mobility("1 + u/2", cosine)); }), HasSubstr("needs discretisation"));
  EXPECT_THAT(error_of([&] { Simulation(cahn_hilliard(with_mobility("1 + u/2", line)), {.method = "seisav"}); }),
              HasSubstr("needs one structure matrix S"));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
