// Kicks and drifts by differences, in few passes over memory.
#include <test/support/cases.hpp>
#include <test/support/falling_energy.hpp>
#include <test/support/matrices.hpp>
#include <test/support/worst.hpp>

#include <seiche/backend/sparse/equal_rows.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/formula/formula_compiler.hpp>
#include <seiche/loop/integrate.hpp>
#include <seiche/method/splitting/nystrom_scheme.hpp>
#include <seiche/problem/beta_fpu.hpp>
#include <seiche/problem/chain.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/oscillator.hpp>
#include <seiche/problem/sine_gordon.hpp>
#include <seiche/simulation/kick_stability.hpp>
#include <seiche/simulation/simulation.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace seiche::test {
namespace TEST_FILE {

Vector random_vector(Index size, unsigned seed = 1) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Vector v(size);
  for (double& x : v) x = normal(random);
  return v;
}

Grid grid_of(const std::vector<Index>& points, Boundary boundary) {
  Grid grid;
  for (const Index n : points) grid.axes.push_back({.intervals = n, .length = 1.5, .boundary = boundary});
  return grid;
}

std::vector<Grid> grids() {
  std::vector<Grid> all;
  for (const Boundary boundary : {Boundary::periodic, Boundary::dirichlet, Boundary::neumann})
    for (const std::vector<Index>& points : std::vector<std::vector<Index>>{{5}, {20}, {1100}, {67, 30}, {9, 12, 70}})
      all.push_back(grid_of(points, boundary));
  return all;
}

TEST(EqualRows, HaveTheProductsAndFormsOfTheirMatrix) {
  for (const Grid& grid : grids()) {
    for (const Discretisation discretisation : {Discretisation::fd2, Discretisation::fd4}) {
      const Stencil K = Stencil::identity(0.7) + (-0.3) * Stencil::laplacian(grid, discretisation);
      const SparseMatrix A = K.sparse_matrix(grid);
      std::optional<EqualRows> rows = EqualRows::of(A, EqualRows::Limit::none);
      ASSERT_TRUE(rows);
      for (const bool cut : {false, true}) {
        if (cut) rows->cut_runs(16);
        const Vector x = random_vector(A.rows());
        Vector Ax(A.rows());
        rows->apply(x, Ax);
        const Vector expected = A * x;
        const double size = (A.cwiseAbs() * x.cwiseAbs()).maxCoeff();
        EXPECT_LE(largest(Ax - expected), 1e-14 * size);
        const double magnitude = x.cwiseAbs().dot(A.cwiseAbs() * x.cwiseAbs());
        EXPECT_NEAR(rows->form(x), x.dot(expected), 1e-14 * magnitude);
        EXPECT_NEAR(rows->form_and_magnitude(x).value, x.dot(expected), 1e-14 * magnitude);
        EXPECT_NEAR(rows->form_and_magnitude(x).magnitude, magnitude, 1e-14 * magnitude);
      }
    }
  }
}

TEST(EqualRows, FormsOfEqualTermsKeepTheirDigits) {
  const std::optional<EqualRows> rows = EqualRows::of(SparseMatrix(0.3 * identity_matrix(1 << 20)));
  const Vector x = Vector::Constant(1 << 20, 0.7);
  const double expected = 0.3 * 0.7 * 0.7 * (1 << 20);
  EXPECT_NEAR(rows->form(x), expected, 20 * epsilon * expected);
  EXPECT_NEAR(rows->form_and_magnitude(x).value, expected, 20 * epsilon * expected);
  EXPECT_NEAR(rows->form_and_magnitude(x).magnitude, expected, 20 * epsilon * expected);
}
TEST(EqualRows, GiveUpWhereEveryRowIsOfItsOwnKind) {
  SparseMatrix A = identity_matrix(1000);
  for (Index i = 0; i < 1000; ++i) A.coeffRef(i, i) = 1 + 1e-3 * static_cast<double>(i);
  EXPECT_FALSE(EqualRows::of(A));
  const Grid narrow = grid_of({1000, 3}, Boundary::periodic);  // few kinds, but no two rows in a row
  EXPECT_FALSE(EqualRows::of(Stencil::laplacian(narrow).sparse_matrix(narrow)));
}

TEST(EqualRows, AreARingWhereOneAxisIsPeriodic) {
  for (const Index points : {1, 2, 3, 4, 5, 20}) {
    const Grid line = grid_of({points}, Boundary::periodic);
    for (const Discretisation discretisation : {Discretisation::fd2, Discretisation::fd4})
      EXPECT_NE(EqualRows::of(Stencil::laplacian(line, discretisation).sparse_matrix(line))->ring(), nullptr) << points;
  }
  for (const Grid& grid :
       {grid_of({20}, Boundary::dirichlet), grid_of({20}, Boundary::neumann), grid_of({6, 5}, Boundary::periodic)})
    EXPECT_EQ(EqualRows::of(Stencil::laplacian(grid).sparse_matrix(grid))->ring(), nullptr);
  SparseMatrix A = identity_matrix(20);
  EXPECT_NE(EqualRows::of(A)->ring(), nullptr);
  A.coeffRef(19, 19) = 2;
  EXPECT_EQ(EqualRows::of(A)->ring(), nullptr);
}

TEST(EqualRows, PassOnANumberThatIsNaN) {
  SparseMatrix A(20, 20);  // all zero: what M is where it is singular
  const std::optional<EqualRows> rows = EqualRows::of(A);
  Vector x = Vector::Ones(20);
  EXPECT_EQ(rows->form(x), 0);
  x[7] = NAN;
  EXPECT_TRUE(std::isnan(rows->form(x)));
}

// By S, M and ∇V as the backend has them.
Vector split_by_products(const System& system, std::span<const Kicks::KickAndDrift> stages, double last, Vector z,
                         double& taken) {
  const Index n = z.size() / 2;
  const auto kick = [&](double c) {
    Vector g(z.size());
    system.gradient(z, g);
    z.tail(n) -= c * g.head(n);
  };
  taken = 0;
  for (const auto& [c, length, decay] : stages) {
    kick(c);
    z.head(n) += length * z.tail(n);
    taken += z.tail(n).squaredNorm() * (1 - decay * decay) / 2;
    z.tail(n) *= decay;
  }
  kick(last);
  return z;
}

TEST(Kicks, EqualThoseByProductsWithTheMatrices) {
  std::vector<NamedProblem> problems = {
      {"sine-Gordon", sine_gordon({.grid = {.points = {1000}, .length = {20.0}}})},
      {"springs", beta_fpu({.points = 700, .gamma = constant_rate(0.1)})},
      {"small", klein_gordon_case()},
  };
  for (const Boundary boundary : {Boundary::periodic, Boundary::dirichlet, Boundary::neumann})
    for (const std::vector<Index>& points :
         std::vector<std::vector<Index>>{{4}, {20}, {64}, {65}, {1537}, {40, 70}, {9, 12, 14}}) {
      GridOptions grid{.points = points, .length = std::vector<double>(points.size(), 3.0)};
      grid.boundary.assign(points.size(), boundary);
      problems.push_back({"KG", klein_gordon({.grid = grid, .alpha = 1.0})});
      problems.back().problem.initial = random_vector(problems.back().problem.size());
    }
  for (const Index points : {2, 3, 4, 5, 20, 61})
    problems.push_back(
        {"differences of order four",
         klein_gordon({.grid = {.points = {points}, .length = {2.0}, .discretisation = Discretisation::fd4}})});
  for (const Index count : {1, 3})
    problems.push_back({"no forces", oscillator({.points = count, .omega_squared = 0.0})});
  Problem free = klein_gordon_case(0.0, 1.0);
  free.potential = nullptr;
  problems.push_back({"no potential", free});
  const std::vector<Kicks::KickAndDrift> stages = {{0.01, 0.02, 0.99}, {-0.01, -0.01, 1.01}, {0.02, 0.03, 0.97}};
  for (const auto& [name, problem] : problems) {
    const System system = find_backend("sparse").system(problem, {});
    ASSERT_TRUE(system.make_kicks) << name;
    const std::unique_ptr<Kicks> kicks = system.make_kicks();
    for (std::size_t count = 1; count <= stages.size(); ++count) {
      const std::span<const Kicks::KickAndDrift> some(stages.data(), count);
      const double last = count < stages.size() ? stages[count].kick : 0.01;
      double taken = 0;
      const Vector expected = split_by_products(system, some, last, system.initial, taken);
      Vector z(problem.size());
      const Kicks::Report report = kicks->split(some, last, system.initial, z);
      EXPECT_LE(largest(z - expected), 1e-13 * largest(expected)) << name;
      EXPECT_NEAR(report.taken, taken, 1e-12 * expected.squaredNorm()) << name;
      Vector kicked = split_by_products(system, {}, 0.01, system.initial, taken);
      EXPECT_NEAR(report.kicked, kicked.tail(kicked.size() / 2).squaredNorm(), 1e-12 * expected.squaredNorm()) << name;
    }
  }
}

TEST(Kicks, GiveTheRunThatProductsOfTheModalBackendGive) {
  int compared = 0;
  for (const std::string method : {"crkn4", "crkn6"}) {
    for (const auto& [name, problem] : grid_cases()) {
      SimulationOptions options{.method = method};
      options.method_options.linear = LinearTreatment::explicit_kicks;
      std::vector<Vector> ends;
      for (const char* backend : {"sparse", "modal"}) {
        options.backend = backend;
        try {
          Simulation simulation(problem, options);
          for (int n = 0; n < 50; ++n) ASSERT_TRUE(simulation.step(1.0 / 64).solved());
          ends.push_back(simulation.physical());
        } catch (const Error&) {
        }
      }
      compared += ends.size() == 2 ? 1 : 0;
      if (ends.size() == 2) {
        EXPECT_LE(largest(ends[0] - ends[1]), 1e-11) << name << method;
      }
    }
  }
  EXPECT_GE(compared, 6);
}

TEST(Kicks, KeepTheLawOverManyBlocksAtEveryStepSize) {
  Problem p = klein_gordon({.grid = {.points = {1300}, .length = {20.0}}, .alpha = 1.0, .gamma = constant_rate(0.1)});
  p.initial *= 3;
  SimulationOptions options{.method = "crkn6"};
  options.method_options.linear = LinearTreatment::explicit_kicks;
  for (const double h : {1.0 / 16, 1.0, 10.0}) {
    Simulation simulation(p, options);
    expect_falling_energy(simulation, h, 60);
  }
}

TEST(Kicks, GoOnWhereASolutionHasFadedUntilItsSquareUnderflows) {
  Problem p = klein_gordon_case();
  p.initial *= 1.57e-162 / p.initial.norm();
  for (const LinearTreatment linear : {LinearTreatment::exact, LinearTreatment::explicit_kicks}) {
    SimulationOptions options{.method = "crkn4"};
    options.method_options.linear = linear;
    Simulation simulation(p, options);
    for (int n = 0; n < 20; ++n) {
      EXPECT_EQ(simulation.step(1.0 / 64).message, "");
      EXPECT_GT(simulation.energy().round_off, 0);
    }
  }
}

// The bound of the scheme itself: an oscillator of frequency one, by kicks that hold all of its force.
TEST(Kicks, AreBoundedUpToTheStabilityThatIsSaidAndNotAboveIt) {
  for (const int order : {4, 6}) {
    const NystromScheme& scheme = nystrom_scheme(order);
    const auto largest_after = [&](double h, int steps) {
      double q = 1, p = 0.3, largest = 0;
      for (int n = 0; n < steps; ++n) {
        for (std::size_t i = 0; i < scheme.b.size(); ++i) {
          p -= scheme.b[i] * h * q;
          if (i < scheme.flows()) q += scheme.a[i] * h * p;
        }
        largest = std::max(largest, std::hypot(q, p));
      }
      return largest;
    };
    const double bound = stability_of_kicks(scheme);
    EXPECT_LT(largest_after(0.98 * bound, 400), 100) << order;
    EXPECT_GT(largest_after(1.05 * bound, 400), 1e6) << order;
  }
}

TEST(Kicks, BeyondTheirStabilityAreSaidBeforeTheRunWhichFails) {
  const Problem p = klein_gordon(
      {.grid = {.points = {64}, .length = {4.0}}, .kappa = 1.0, .alpha = 1.0, .gamma = constant_rate(0.1)});
  SimulationOptions options{.method = "crkn4"};
  options.method_options.linear = LinearTreatment::explicit_kicks;
  const auto run = [&](double h) {
    Simulation simulation(p, options);
    return integrate(simulation.system(), simulation.stepper(), simulation.state(), {.h = h, .t_end = 20 * h});
  };
  const Simulation simulation(p, options);
  EXPECT_EQ(beyond_stability(simulation, 1.0 / 16), "");
  const RunReport stable = run(1.0 / 16);
  EXPECT_EQ(stable.status, RunReport::Status::success) << stable.message;
  EXPECT_EQ(stable.replaced.count, 0);
  EXPECT_THAT(beyond_stability(simulation, 0.5), testing::HasSubstr("h = 0.5 is beyond the stability of crkn4"));
  const RunReport unstable = run(0.5);
  EXPECT_EQ(unstable.status, RunReport::Status::failed);
  EXPECT_GT(unstable.replaced.count, 2);
  EXPECT_LE(unstable.replaced.count, unstable.steps);
  EXPECT_GE(unstable.fallbacks, unstable.replaced.count / 2);
  EXPECT_THAT(unstable.message,
              testing::AllOf(testing::HasSubstr(fmt::format("in {} of 20 steps", unstable.replaced.count)),
                             testing::HasSubstr("a smaller h, or linear = \"exact\"")));
  EXPECT_EQ(beyond_stability(Simulation(p, {.method = "crkn4"}), 0.5), "");
}

TEST(Kicks, AreWhatExplicitMethodsRunOnByThemselves) {
  SimulationOptions options{.method = "crkn4"};
  EXPECT_EQ(Simulation(klein_gordon_case(), options).backend().name, "modal");
  options.method_options.linear = LinearTreatment::explicit_kicks;
  EXPECT_EQ(Simulation(klein_gordon_case(), options).backend().name, "sparse");
  EXPECT_EQ(Simulation(klein_gordon({.grid = {.discretisation = Discretisation::spectral}}), options).backend().name,
            "modal");
  EXPECT_EQ(Simulation(chain({.points = 40, .mass = 2.0}), options).backend().name, "modal");  // p is no velocity
}

TEST(Rates, RatesThatStepsDoNotResolveAreSaidBeforeTheRun) {
  const Problem p = oscillator({.gamma = formula_rate(compile_formula("1000*sin(3*t)^2", {"t"}))});
  EXPECT_THAT(beyond_rate(Simulation(p, {.method = "egc8"}), 1.0 / 512, {0, 10}),
              testing::AllOf(testing::HasSubstr("1000*sin(3*t)^2 reaches 1e+03"), testing::HasSubstr("h ≤ 0.001")));
  EXPECT_EQ(beyond_rate(Simulation(p, {.method = "egc8"}), 1e-4, {0, 10}), "");
  EXPECT_EQ(beyond_rate(Simulation(p, {.method = "seisav"}), 1.0 / 512, {0, 10}), "") << "takes its integral";
  EXPECT_EQ(beyond_rate(Simulation(oscillator(), {.method = "egc8"}), 1, {0, 10}), "");
}

TEST(Rates, RatesOfASplitDampingThatBalancesForcesAreSaidBeforeTheRun) {
  const Problem stiff = oscillator({.gamma = constant_rate(1000)});
  EXPECT_THAT(beyond_splitting(Simulation(stiff, {.method = "seisav"}), 0.1),
              testing::AllOf(testing::HasSubstr("wrong by the factor hγ/2: it is 50"),
                             testing::HasSubstr("h ≤ 0.001")));
  EXPECT_EQ(beyond_splitting(Simulation(stiff, {.method = "seisav"}), 1e-3), "");
  EXPECT_EQ(beyond_splitting(Simulation(stiff, {.method = "egc4"}), 0.1), "") << "damping in its exponential";
  EXPECT_EQ(beyond_splitting(Simulation(stiff, {.method = "eisav"}), 0.1), "");
  EXPECT_THAT(beyond_splitting(Simulation(stiff, {.method = "chin4"}), 0.1),
              testing::HasSubstr("of order four only where hγ < 2"));
  for (const auto& [name, problem] : golden_cases())
    EXPECT_EQ(beyond_splitting(Simulation(problem, {.method = "seisav"}), 1.0 / 16), "") << name;
}

}  // namespace TEST_FILE
}  // namespace seiche::test
