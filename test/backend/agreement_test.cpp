// Backends agree with the reference, for every method.
#include <test/support/cases.hpp>
#include <test/support/repetitions.hpp>
#include <test/support/worst.hpp>

#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/variable_wave.hpp>
#include <seiche/simulation/simulation.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace seiche::test {
namespace TEST_FILE {

Vector state_after(const Problem& problem, std::string_view method, std::string_view backend, double h, int steps) {
  Simulation simulation(problem, {.method = std::string(method), .backend = std::string(backend)});
  for (int n = 0; n < steps; ++n) {
    const StepReport report = simulation.step(h);
    EXPECT_TRUE(report.solved()) << report.message;
  }
  return simulation.physical();
}

// Elsewhere a backend that refuses a problem is left out: here is said which do, so that none can vanish unseen.
TEST(Agreement, EveryProblemRunsOnTheBackendsThatItShould) {
  const std::vector<std::string> couples_all_points = {
      "KG_2d_even_spectral", "KG_3d_mixed_spectral", "gKdV_spectral", "gKdV_dealiased",
      "KG_2d_dealiased",     "NLS_focusing",         "Burgers",       "Cahn_Hilliard_mobility_spectral"};
  for (const auto& [name, problem] : all_cases()) {
    std::vector<std::string> expected = {"dense"};
    if (!problem.matrices) expected.emplace_back("modal");
    if (std::find(couples_all_points.begin(), couples_all_points.end(), name) == couples_all_points.end())
      expected.emplace_back("sparse");
    expected.emplace_back("reference");
    std::vector<std::string> found;
    for (const BackendEntry& backend : backends_for(problem)) found.emplace_back(backend.name);
    EXPECT_EQ(found, expected) << name;
  }
}

// docs/performance.md has the sizes from which the others are faster.
TEST(Agreement, FewUnknownsHaveFullMatrices) {
  const auto chosen = [](const Problem& problem) { return automatic_backend(problem).name; };
  const auto on_grid = [](Index points) {
    return klein_gordon({.grid = {.points = {points}, .length = {0.1 * static_cast<double>(points)}}});
  };
  const auto with_matrices = [](Index points) {
    return variable_wave({.grid = {.points = {points}, .length = {2.0}}});
  };
  EXPECT_EQ(chosen(on_grid(12)), "dense");
  EXPECT_EQ(chosen(on_grid(13)), "modal");
  Index points = 4;
  while (with_matrices(points + 1).size() <= 48) ++points;
  EXPECT_EQ(chosen(with_matrices(points)), "dense");
  EXPECT_EQ(chosen(with_matrices(points + 1)), "sparse");
}

class AgreementOf : public testing::TestWithParam<std::string> {};

TEST_P(AgreementOf, EveryBackendAgreesWithTheReferenceOverTenTimeUnits) {
  const std::string& method = GetParam();
  for (const auto& [name, problem] : all_cases()) {
    if (!applies(method, problem)) continue;
    constexpr double h = 1.0 / 64;
    constexpr int steps = repetitions(640);
    const Vector expected = state_after(problem, method, "reference", h, steps);
    for (const BackendEntry& backend : backends_for(problem)) {
      if (backend.name == "reference") continue;
      const Vector z = state_after(problem, method, backend.name, h, steps);
      EXPECT_LE(largest(z - expected), 1e-11) << name << " " << backend.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, AgreementOf, testing::ValuesIn(method_names()),
                         [](const auto& of) { return of.param; });

TEST(Agreement, TheRightHandSideIsTheSameOnEveryBackend) {
  for (const auto& [name, problem] : all_cases()) {
    const System reference = find_backend("reference").system(problem, {});
    Vector expected(reference.space->size());
    reference.right_hand_side(0.3, reference.initial, expected);
    for (const BackendEntry& backend : backends_for(problem)) {
      const System system = backend.system(problem, {});
      Vector out(system.space->size());
      system.right_hand_side(0.3, system.initial, out);
      EXPECT_LE(largest(system.space->physical(out) - expected), 1e-13 * (1 + largest(expected)))
          << name << " " << backend.name;
    }
  }
}

TEST(Agreement, CoordinatesAreOrthonormalAndInvertible) {
  for (const Index points : {1, 2, 3, 4, 7, 20, 33}) {
    for (const Boundary boundary : {Boundary::periodic, Boundary::dirichlet, Boundary::neumann}) {
      if (boundary == Boundary::dirichlet && points < 2) continue;
      Problem p = duffing_case();
      p.grid.axes = {{points, 1.0, boundary}};
      p.initial = Vector::Random(p.size());
      for (const BackendEntry& backend : backends()) {
        const System system = backend.system(p, {});
        EXPECT_NEAR(system.initial.norm(), p.initial.norm(), 1e-14 * static_cast<double>(points))
            << backend.name << points;
        EXPECT_LE((system.space->physical(system.initial) - p.initial).norm(), 1e-14 * static_cast<double>(points))
            << backend.name << points;
      }
    }
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
