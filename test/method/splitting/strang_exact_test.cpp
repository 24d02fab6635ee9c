// ∇V of a splitting taken from point to point, without a transform, and what damping takes in its steps.
#include <test/support/cases.hpp>

#include <gtest/gtest.h>
#include <seiche/backend/backends.hpp>
#include <seiche/core/generic_state.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/method/projection/step_dissipation.hpp>
#include <seiche/method/splitting/strang_exact.hpp>
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

// By energies where dissipation follows from them, and by gradients elsewhere: both are Q at the two ends.
TEST(StrangExact, KnowsWhatIsTakenAtBothEnds) {
  constexpr double h = 1.0 / 64;
  int by_energies = 0, by_gradients = 0;
  for (const auto& [name, problem] : all_cases()) {
    for (const BackendEntry& backend : backends_for(problem)) {
      SCOPED_TRACE(name + " " + std::string(backend.name));
      const System system = backend.system(problem, {});
      const auto phi = system.make_phi();
      if (StepDissipation::kind_of(system, *phi) != StepDissipation::Kind::general) continue;
      const std::unique_ptr<BaseStep> step = strang_exact(system, *phi, EnergyLaw::interval);
      State s{.z = system.initial};
      s.energy = system.energy(s.z);
      step->remember_nothing(s);
      Vector z(s.z);
      ASSERT_TRUE(step->compute(s, 0, h, z));
      step->potential_energy(z);
      const std::int64_t gradients = system.potential->counts().gradients;
      const StepDissipation::Amount amount = step->dissipated(s, 0, h, z, system.energy(z));
      if (StepDissipation::energies_tell(system, *phi)) {
        EXPECT_EQ(system.potential->counts().gradients, gradients);
        ++by_energies;
      } else {
        ++by_gradients;
      }
      Vector gradient = Vector::Zero(z.size()), scratch(gradient), gradient_H(gradient);
      StepDissipation::Sum expected;
      double size = 0;
      for (const auto& [t, end] : {std::pair<double, const Vector&>{0, s.z}, {h, z}}) {
        system.potential->gradient(end, gradient);
        const System::Dissipation q = system.dissipation(t, end, gradient, scratch, gradient_H);
        expected.add(h / 2, q);
        size += h * q.round_off / (100 * epsilon);
      }
      EXPECT_NEAR(amount.fine, expected.taken, 1e-13 * size);
      EXPECT_NEAR(amount.work, expected.work, 1e-13 * size);
      EXPECT_EQ(amount.negative, expected.negative);
    }
  }
  EXPECT_GE(by_energies, 4);
  EXPECT_GE(by_gradients, 4);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
