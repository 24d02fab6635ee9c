// Errors over the paper's whole time span against those of an independent implementation (test/data/golden.json).
#include <test/support/convergence.hpp>
#include <test/support/golden.hpp>

#include <gtest/gtest.h>

#include <map>

namespace seiche::test {
namespace TEST_FILE {

const Reference& reference_for(const NamedProblem& c) {
  static std::map<std::string, Reference> cache;
  const auto found = cache.find(c.name);
  if (found != cache.end()) return found->second;
  const std::vector<double> h = golden_methods(c.name).front().step_sizes;
  return cache[c.name] = make_reference(c.problem, sample_times(h, 50.0));
}

bool solves_for_eta(const GoldenMethod& method) { return find_method(method.method).kind.takes_solver; }

class GoldenErrors : public testing::TestWithParam<std::string> {};

TEST_P(GoldenErrors, AtEveryStepSizeOfEveryMethodAreThoseOfTheOracle) {
  for (const NamedProblem& c : golden_cases()) {
    for (const GoldenMethod& method : golden_methods(c.name)) {
      for (const double h : method.step_sizes) {
        const nlohmann::json& golden = method.result(h);
        const Errors errors = errors_against(reference_for(c), c.problem, method.options(GetParam()), h);
        ASSERT_EQ(errors.failure, "");
        const std::string where = c.name + " " + method.golden_name + " h = " + std::to_string(h);
        const double expected = golden.at("err").get<double>();
        if (solves_for_eta(method)) {  // plain Newton amplifies round-off at turning points: a factor, not digits
          EXPECT_LE(errors.solution, 1.5 * expected) << where;
          EXPECT_GE(errors.solution, expected / 1.5) << where;
        } else {
          EXPECT_NEAR(errors.solution, expected, (expected < 1e-9 ? 0.02 : 1e-3) * expected) << where;
        }
        // A step that plain Newton leaves unresolved breaks the law by what round-off decides; the oracle has such too.
        if (errors.unresolved > 0) continue;
        const double expected_energy = golden.at("eH").get<double>();
        EXPECT_NEAR(errors.energy, expected_energy, 0.01 * expected_energy) << where;
      }
    }
  }
}

TEST_P(GoldenErrors, OfTheRobustMultiplierAreNoLargerThanThoseOfPlainNewton) {
  for (const NamedProblem& c : golden_cases()) {
    for (const GoldenMethod& method : golden_methods(c.name)) {
      if (!solves_for_eta(method)) continue;
      for (const double h : method.step_sizes) {
        const Errors errors =
            errors_against(reference_for(c), c.problem, method.options(GetParam(), ScalarSolver::robust), h);
        ASSERT_EQ(errors.failure, "");
        EXPECT_EQ(errors.unresolved, 0);
        EXPECT_LE(errors.solution, 1.5 * method.result(h).at("err").get<double>()) << c.name << method.golden_name << h;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, GoldenErrors, testing::Values("dense", "modal"),
                         [](const auto& backend) { return backend.param; });

}  // namespace TEST_FILE
}  // namespace seiche::test
