// One step of every method against an independent implementation (test/data/golden.json).
#include <test/support/golden.hpp>
#include <test/support/worst.hpp>

#include <gtest/gtest.h>

namespace seiche::test {
namespace TEST_FILE {

TEST(Golden, InitialDataAreThoseOfTheOracle) {
  for (const auto& [name, problem] : golden_cases()) {
    const Vector z0 = golden_vector(golden_case(name).at("z0"));
    ASSERT_EQ(z0.size(), problem.initial.size()) << name;
    EXPECT_LE(largest(z0 - problem.initial), 1e-14 * largest(z0)) << name;
  }
}

TEST(Golden, OneStepOfEveryMethodOnEveryBackendAgreesToThirteenDigits) {
  int compared = 0;
  for (const auto& [name, problem] : golden_cases()) {
    for (const GoldenMethod& method : golden_methods(name)) {
      const Vector expected = golden_vector(method.result(method.step_sizes.front()).at("z1"));
      for (const BackendEntry& backend : backends()) {
        Simulation simulation(problem, method.options(backend.name));
        ASSERT_TRUE(simulation.step(method.step_sizes.front()).solved());
        const double distance = largest(simulation.physical() - expected);
        EXPECT_LE(distance, 1e-13 * largest(expected)) << name << " " << method.golden_name << " " << backend.name;
        ++compared;
      }
    }
  }
  EXPECT_EQ(compared, static_cast<int>(backends().size()) * (9 + 9 + 9 + 9));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
