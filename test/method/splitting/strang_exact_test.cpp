// ∇V of a splitting taken from point to point, without a transform.
#include <test/support/cases.hpp>

#include <gtest/gtest.h>
#include <seiche/backend/backends.hpp>
#include <seiche/core/generic_state.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/problem/gkdv.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/simulation/simulation.hpp>

namespace seiche::test {
namespace TEST_FILE {

TEST(NodalForce, IsThatOfTheModes) {
  int compared = 0;
  for (const auto& [name, problem] : all_cases()) {
    if (problem.matrices) continue;
    const System system = find_backend("modal").system(problem, {});
    const System::NodalForce nodal = system.make_nodal_force ? system.make_nodal_force() : nullptr;
    if (!nodal) continue;
    ++compared;
    const Vector z = generic_state(*system.space);
    Vector gradient = Vector::Zero(z.size()), force = gradient;
    system.potential->gradient(z, gradient);
    system.linear->apply_S(gradient, force);
    Vector at_points(problem.size());
    const Potential::Counts before = system.potential->counts();
    nodal(system.space->physical(z), at_points);
    EXPECT_EQ(system.potential->counts().gradients, before.gradients + 1) << name;
    const Vector expected = system.space->physical(force);
    EXPECT_LE((at_points - expected).lpNorm<Eigen::Infinity>(), 1e-13 * (1 + expected.lpNorm<Eigen::Infinity>()))
        << name;
  }
  EXPECT_GE(compared, 5);
}

// Grids of more axes may be shared by processes, whose solutions have the bits of one process.
TEST(NodalForce, IsForGridsOfOneAxisWithDifferences) {
  const auto has_one = [](const Problem& problem) {
    const System system = find_backend("modal").system(problem, {});
    return system.make_nodal_force && system.make_nodal_force() != nullptr;
  };
  EXPECT_TRUE(has_one(gkdv({.length = 8.0, .points = 16})));
  EXPECT_FALSE(has_one(gkdv({.length = 8.0, .points = 16, .discretisation = Discretisation::spectral})));
  EXPECT_FALSE(has_one(klein_gordon(
      {.grid = {.points = {16}, .length = {1.6}, .discretisation = Discretisation::spectral, .two_thirds = true}})));
  EXPECT_FALSE(has_one(klein_gordon({.grid = {.points = {8, 8}, .length = {0.8, 0.8}}})));
}

// The modal backend at points, the dense one by its matrices.
TEST(NodalForce, LeavesTheSplittingAsItWas) {
  const Problem problem = gkdv({.length = 16.0, .points = 32, .mu = constant_rate(0.1)});
  Simulation modal(problem, {.method = "strang_exact", .backend = "modal"});
  Simulation dense(problem, {.method = "strang_exact", .backend = "dense"});
  for (int n = 0; n < 64; ++n) {
    ASSERT_TRUE(modal.step(1.0 / 32).solved());
    ASSERT_TRUE(dense.step(1.0 / 32).solved());
  }
  EXPECT_LE((modal.physical() - dense.physical()).lpNorm<Eigen::Infinity>(), 1e-13);
  const Potential::Counts at_points = modal.system().potential->counts(),
                          by_matrices = dense.system().potential->counts();
  EXPECT_EQ(at_points.gradients, by_matrices.gradients);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
