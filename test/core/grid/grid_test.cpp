// Grids: operators, modes and coordinates in every dimension, boundary and discretisation; exact solutions.
#include <test/support/cases.hpp>
#include <test/support/matrices.hpp>
#include <test/support/worst.hpp>

#include <seiche/backend/backends.hpp>
#include <seiche/backend/fft/transform.hpp>
#include <seiche/backend/grid/segment.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/problem/gkdv.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/nls.hpp>
#include <seiche/problem/sine_gordon.hpp>
#include <seiche/study/reference.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <numbers>

namespace seiche::test {
namespace TEST_FILE {

using enum Boundary;
constexpr std::array discretisations = {Discretisation::fd2, Discretisation::fd4, Discretisation::spectral};

TEST(Grid, PointsAreNumberedWithTheLastAxisFastest) {
  const Grid grid{.axes = {{2, 2.0, periodic}, {3, 3.0, dirichlet}, {2, 1.0, neumann}}};
  EXPECT_EQ(grid.unknowns(), 2 * 2 * 2);
  EXPECT_DOUBLE_EQ(grid.coordinate(5, 0), 2.0);
  EXPECT_DOUBLE_EQ(grid.coordinate(5, 1), 1.0);
  EXPECT_DOUBLE_EQ(grid.coordinate(5, 2), 0.75);
}

// S and M of the modal backend, brought back to the grid, are the matrices of the dense one.
TEST(Grid, SymbolsAreTheEigenvaluesOfTheMatrices) {
  for (const auto& [name, problem] : grid_cases()) {
    const System modal = find_backend("modal").system(problem, {});
    for (const auto& [operator_name, stencil] : {std::pair("S", &problem.S), std::pair("M", &problem.M)}) {
      const bool is_S = stencil == &problem.S;
      const Matrix found = matrix_of(modal, [&](const Vector& x, Vector& y) {
        is_S ? modal.linear->apply_S(x, y) : modal.linear->apply_M(x, y);
      });
      const Matrix expected = stencil->matrix(problem.grid);
      EXPECT_LE(largest(found - expected), 2e-14 * (1 + largest(expected))) << name << " " << operator_name;
    }
  }
}

TEST(Grid, DerivativesConvergeAtTheOrderOfTheirDiscretisation) {
  const double k = 2 * std::numbers::pi;
  for (const Discretisation d : discretisations) {
    std::vector<double> errors;
    for (const Index n : {16, 32}) {
      const Grid grid{.axes = {{n, 1.0, periodic}}};
      Vector u(n), first(n), second(n);
      for (Index i = 0; i < n; ++i) {
        const double x = grid.coordinate(i, 0);
        u[i] = std::exp(std::sin(k * x));
        first[i] = k * std::cos(k * x) * u[i];
        second[i] = k * k * (square(std::cos(k * x)) - std::sin(k * x)) * u[i];
      }
      errors.push_back(largest(Stencil::derivative(grid, 0, d).matrix(grid) * u - first) / k +
                       largest(Stencil::laplacian(grid, d).matrix(grid) * u - second) / (k * k));
    }
    const double order = std::log2(errors[0] / errors[1]);
    if (d == Discretisation::fd2) {
      EXPECT_NEAR(order, 2, 0.3);
    }
    if (d == Discretisation::fd4) {
      EXPECT_NEAR(order, 4, 0.6);
    }
    if (d == Discretisation::spectral) {
      EXPECT_LE(errors[1], 1e-12);
    }
  }
}

TEST(Grid, EigenfunctionsOfEveryBoundaryAreEigenfunctions) {
  for (const Boundary boundary : {periodic, dirichlet, neumann}) {
    const Grid grid{.axes = {{12, 3.0, boundary}}};
    const double kappa = boundary == periodic ? 2 * std::numbers::pi / 3 : std::numbers::pi / 3;
    Vector u(grid.unknowns());
    for (Index i = 0; i < u.size(); ++i) {
      const double x = grid.coordinate(i, 0);
      u[i] = boundary == dirichlet ? std::sin(kappa * x) : std::cos(kappa * x);
    }
    const Vector image = Stencil::laplacian(grid, Discretisation::spectral).matrix(grid) * u;
    EXPECT_LE((image + square(kappa) * u).norm(), 1e-12) << static_cast<int>(boundary);
  }
}

TEST(Grid, LongLinesSideBySideAreTransformedOnSeveralThreads) {
  const Grid grid{.axes = {{5, 1.0, dirichlet}, {32768, 1.0, dirichlet}}};
  Vector u(grid.unknowns());
  for (Index j = 0; j < u.size(); ++j) u[j] = std::sin(0.1 * static_cast<double>(j % 4099));
  Vector one(u.size()), two(u.size());
  modal_transform(grid)->forward(all(u), all(one));
  const auto on_two = modal_transform(grid, {.threads = 2});
  for (int i = 0; i < 20; ++i) {
    on_two->forward(all(u), all(two));
    ASSERT_EQ(one, two);
  }
}

// Long lines are split, those of odd or short lengths are not.
TEST(Grid, SinesOfLinesOfAnyLengthAreTheirSums) {
  for (const Index intervals : {2, 3, 4, 127, 128, 130, 132, 256, 260, 516, 1000, 1024, 2048}) {
    const Grid grid{.axes = {{intervals, 1.0, dirichlet}}};
    const auto transform = modal_transform(grid);
    Vector u(grid.unknowns()), slots(grid.unknowns()), back(grid.unknowns());
    for (Index j = 0; j < u.size(); ++j) u[j] = std::sin(0.1 * static_cast<double>(j * j)) + 0.3;
    transform->forward(all(u), all(slots));
    transform->inverse(all(slots), all(back));
    EXPECT_LE((back - u).lpNorm<Eigen::Infinity>(), 1e-14) << intervals;
    double error = 0;
    for (Index k = 1; k < intervals; ++k) {
      double sum = 0;
      for (Index j = 1; j < intervals; ++j)  // j k modulo 2N, exactly
        sum += u[j - 1] * std::sin(std::numbers::pi * static_cast<double>(j * k % (2 * intervals)) /
                                   static_cast<double>(intervals));
      error = worse(error, std::abs(slots[k - 1] - std::sqrt(2.0 / static_cast<double>(intervals)) * sum));
    }
    EXPECT_LE(error, 1e-13) << intervals;
  }
}

TEST(Grid, TheTwoThirdsRuleCostsNothingBeforeItIsUsed) {
  const std::clock_t begin = std::clock();
  const Problem p =
      gkdv({.length = 10, .points = 1 << 15, .discretisation = Discretisation::spectral, .two_thirds = true});
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  EXPECT_EQ(p.size(), 1 << 15);
  EXPECT_LE(seconds, 5) << "of a processor, for a twentieth of one; a cosine for every pair of points takes ten";
}

double distance_from(const Problem& p, double t_end, const std::function<double(double x)>& exact) {
  const Reference solution = make_reference(p, {0.0, t_end});
  const std::span<const double> z = solution.state(1);
  double distance = 0;
  for (Index i = 0; i < p.grid.unknowns(); ++i)
    distance = worse(distance, std::abs(z[static_cast<std::size_t>(i)] - exact(p.grid.coordinate(i, 0))));
  return distance;
}

TEST(Grid, SpectralSineGordonFollowsTheBreather) {
  const double length = 60;
  const auto breather = [&](double x) { return sine_gordon_breather(0.5, x - length / 2, 3.0); };
  SineGordon options{.grid = {.points = {256}, .length = {length}, .discretisation = Discretisation::spectral}};
  EXPECT_LE(distance_from(sine_gordon(options), 3.0, breather), 1e-8);
  options.grid.discretisation = Discretisation::fd2;  // the same number of points, or this could not fail
  EXPECT_GE(distance_from(sine_gordon(options), 3.0, breather), 1e-3);
}

TEST(Grid, SpectralKdvFollowsTheSoliton) {
  const double length = 40;
  const double c = 1.5;
  const auto soliton = [&](double x) {  // u_t + u_xxx + 3(u²)_x = 0
    return c / 2 / square(std::cosh(std::sqrt(c) / 2 * (x - length / 2)));
  };
  const double t = 2.0;
  Problem p =
      gkdv({.length = length, .points = 128, .discretisation = Discretisation::spectral, .exponent = 1, .sigma = 3.0});
  for (Index i = 0; i < p.size(); ++i) p.initial[i] = soliton(p.grid.coordinate(i, 0));
  EXPECT_LE(distance_from(p, t, [&](double x) { return soliton(x - c * t); }), 1e-7);
}

TEST(Grid, SpectralNlsFollowsTheSoliton) {
  Nls options{.grid = {.points = {256}, .length = {40.0}, .discretisation = Discretisation::spectral},
              .kappa = 2.0,
              .amplitude = 1.2};
  const double t = 3.0;
  const auto real_part = [&](double x) {
    return nls_soliton(options.kappa, options.amplitude, options.velocity, x - 20, t).real();
  };
  EXPECT_LE(distance_from(nls(options), t, real_part), 1e-8);
  options.grid.discretisation = Discretisation::fd2;  // the same number of points, or this could not fail
  EXPECT_GE(distance_from(nls(options), t, real_part), 1e-3);
}

// Slots of the modes of a line with k < bound, in units that do not depend on the number of points.
Vector low_modes(const Vector& values, Index bound) {
  Problem p = gkdv({.points = values.size()});
  p.initial = values;
  const System modal = find_backend("modal").system(p, {});
  return modal.initial.head(2 * bound) / std::sqrt(static_cast<double>(values.size()));
}

TEST(Grid, WithTheTwoThirdsRuleAQuadraticForceIsFreeOfAliases) {
  const Index n = 30;
  const Gkdv coarse{.length = 1.0,
                    .points = n,
                    .discretisation = Discretisation::spectral,
                    .two_thirds = true,
                    .exponent = 1,
                    .sigma = 1.0};
  Gkdv fine = coarse;  // four times the points: no aliases, and nothing cut off
  fine.points = 4 * n;
  fine.two_thirds = false;
  Gkdv aliased = coarse;
  aliased.two_thirds = false;
  const auto force = [](const Gkdv& options, double high) {
    const Problem p = gkdv(options);
    Vector u(p.size());
    for (Index i = 0; i < u.size(); ++i) {
      const double x = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(u.size());
      u[i] = 0.3 + std::cos(9 * x) - 0.7 * std::sin(8 * x) + 0.2 * std::cos(3 * x) + high * std::cos(12 * x);
    }
    Vector g(p.size());
    p.potential->value_and_gradient({u.data(), static_cast<std::size_t>(u.size())},
                                    {g.data(), static_cast<std::size_t>(g.size())});
    return g;
  };
  const Index all = n / 2 + 1;
  const Vector exact = low_modes(force(fine, 0.0), 10);  // k = 0 … 9 < N/3
  const Vector found = low_modes(force(coarse, 0.5), all);
  EXPECT_LE((found.head(20) - exact).norm(), 1e-14);
  EXPECT_LE(found.tail(found.size() - 20).norm(), 1e-14);
  EXPECT_GE((low_modes(force(aliased, 0.5), 10) - exact).norm(), 0.1);  // 12 + 12 folds back to 6
}

TEST(Grid, TheTwoThirdsRuleIsRefusedWhereThereAreNoModesToLeaveOut) {
  GridOptions grid{.points = {8}, .discretisation = Discretisation::fd2, .two_thirds = true};
  EXPECT_THROW(klein_gordon({.grid = grid}), Error);
  grid.discretisation = Discretisation::spectral;
  EXPECT_NO_THROW(klein_gordon({.grid = grid}));
  grid.boundary = {dirichlet};
  EXPECT_THROW(klein_gordon({.grid = grid}), Error);
}

TEST(Grid, AGridThatDoesNotFitIntoMemoryIsRefusedBeforeItIsAllocated) {
  try {
    klein_gordon({.grid = {.points = {1 << 26, 1 << 26}}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("9.01e+17 bytes"), std::string::npos) << error.what();
  }
}

TEST(Grid, ListsThatDoNotFitAreRefused) {
  EXPECT_THROW(klein_gordon({.grid = {.points = {8, 8}, .length = {1.0, 1.0, 1.0}}}), Error);
  EXPECT_THROW(klein_gordon({.grid = {.points = {8, 8, 8, 8}}}), Error);
  EXPECT_THROW(klein_gordon({.grid = {.points = {1}, .boundary = {dirichlet}}}), Error);
  EXPECT_THROW(Stencil::derivative({.axes = {{8, 1.0, dirichlet}}}), Error);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
