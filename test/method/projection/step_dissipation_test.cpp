// The quadratures of the dissipation: rules inside one another, and dissipation that follows from energies.
#include <test/support/cases.hpp>

#include <seiche/backend/backends.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/method/collocation/collocation_weights.hpp>
#include <seiche/method/projection/step_dissipation.hpp>
#include <seiche/problem/gkdv.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace seiche::test {
namespace TEST_FILE {

TEST(NestedRules, TheFinerOneIsExactBeyondTheCoarser) {
  for (int s = 1; s <= 4; ++s) {
    const NestedRules rules(s);
    ASSERT_EQ(rules.more.size(), s - 1);
    Eigen::VectorXd nodes(2 * s + 1);
    nodes << 0, 1, rules.coarse.nodes, rules.more;
    EXPECT_GT(rules.fine.minCoeff(), 0) << s;
    EXPECT_GT(nodes.tail(2 * s - 1).minCoeff(), 0) << s;
    EXPECT_LT(nodes.tail(2 * s - 1).maxCoeff(), 1) << s;
    const auto miss = [](const Eigen::VectorXd& x, const Eigen::VectorXd& weights, int degree) {
      return std::abs(weights.dot(x.array().pow(degree).matrix()) - 1.0 / (degree + 1));
    };
    for (int degree = 0; degree <= (s % 2 == 0 ? 3 * s - 1 : 3 * s); ++degree)
      EXPECT_LE(miss(nodes, rules.fine, degree), 1e-14) << s << " " << degree;
    EXPECT_GT(miss(rules.coarse.nodes, rules.coarse.weights, 2 * s), 1e-6) << s;
    EXPECT_LE(miss(nodes, rules.fine, 2 * s), 1e-14) << s;
  }
}

StepOutput constant_force() {
  const Eigen::MatrixXd C = Eigen::MatrixXd::Ones(1, 1);
  return {.forces = 1, .order = 1, .weights = [C](double theta) { return collocation_weights(C, theta); }};
}

// Of one step with the force of its start: by energies, and node by node with gradients.
TEST(StepDissipation, FollowsFromEnergiesWhereDampingIsAMultipleOfTheState) {
  constexpr int s = 3;
  constexpr double h = 1.0 / 64;
  int compared = 0;
  for (const auto& [name, problem] : all_cases()) {
    for (const BackendEntry& backend : backends_for(problem)) {
      SCOPED_TRACE(name + " " + std::string(backend.name));
      const System system = backend.system(problem, {});
      const auto phi = system.make_phi();
      const StepDissipation::Rules rules{GaussRule(s), GaussRule(s + 2), NestedRules(s)};
      StepDissipation dissipation(system, *phi, constant_force(), constant_force(), rules);
      if (!dissipation.follows_energies()) continue;
      const Vector& z = system.initial;
      std::vector<Vector> force(1, z), end(1, z);
      system.potential->gradient(z, force[0]);
      phi->map(constant_force().at(Eigen::VectorXd::Ones(1), PhiRows::Outputs::all), h)->apply(z, force, end);
      const StepDissipation::Amount by_nodes = dissipation.measure(0, h, z, force);

      const std::int64_t gradients = system.potential->counts().gradients;
      const StepDissipation::Amount by_energies =
          dissipation.measure(0, h, z, force, dissipation.energies(z, system.energy(z)),
                              dissipation.energies(end[0], system.energy(end[0])));
      EXPECT_EQ(system.potential->counts().gradients, gradients);
      const double size = 2 * h * (system.linear->quadratic_energy(z) + system.potential->magnitude(z));
      EXPECT_NEAR(by_energies.fine, by_nodes.fine, 1e-10 * size);
      EXPECT_NEAR(by_energies.doubt, by_nodes.doubt, 1e-12 * size);
      EXPECT_EQ(by_energies.negative, by_nodes.negative);
      ++compared;
    }
  }
  EXPECT_GE(compared, 8);
}

// A damping rate that varies in time stays a multiple of the state; one that varies in space does not.
TEST(StepDissipation, FollowsNoEnergiesWhereSomethingElseDissipates) {
  const auto follows = [](const Problem& problem) {
    const System system = find_backend("modal").system(problem, {});
    const auto phi = system.make_phi();
    return StepDissipation(system, *phi, constant_force(), constant_force(),
                           {GaussRule(1), GaussRule(3), NestedRules(1)})
        .follows_energies();
  };
  EXPECT_TRUE(follows(gkdv_case()));
  EXPECT_FALSE(follows(gkdv_case(0.0)));  // nothing to know
  EXPECT_FALSE(follows(klein_gordon_case()));
  Problem leaky = gkdv_case();
  leaky.S(0, 0) = leaky.S(0, 0) + 0.01 * Stencil::laplacian(leaky.grid);
  EXPECT_FALSE(follows(leaky));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
