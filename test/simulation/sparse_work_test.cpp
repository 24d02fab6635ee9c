// What exponentials of the sparse backend cost where a step is long beside the fastest rate.
#include <seiche/backend/backends.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/problem/sparse.hpp>
#include <seiche/simulation/kick_stability.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace seiche::test {
namespace TEST_FILE {

// Two oscillators, of the rates 10⁷ and 1.
Problem fast_and_slow() {
  SparseMatrix M = identity_matrix(4);
  M.coeffRef(0, 0) = 1e14;
  Problem p = sparse_problem({.matrices = {.S = {}, .M = M, .D = {}}});
  p.initial = Vector{{1e-7, 1, 0.3, 0.3}};
  return p;
}

std::string words_on_work(std::string_view method, double h, const SparseOptions& options = {}) {
  const Problem problem = fast_and_slow();
  const Simulation simulation(problem, {.method = std::string(method), .backend = "sparse"});
  return work_of_exponentials(simulation, options, h, 10);
}

TEST(SparseWork, TheWorkOfLongStepsIsSaidBeforeTheRun) {
  EXPECT_EQ(words_on_work("egc4", 1e-5), "");
  EXPECT_NE(words_on_work("egc4", 0.1).find("1e+05 Krylov substeps each"), std::string::npos)
      << words_on_work("egc4", 0.1);
  EXPECT_NE(words_on_work("seisav", 0.1).find("Padé parts of degree 12"), std::string::npos)
      << words_on_work("seisav", 0.1);
  EXPECT_EQ(words_on_work("seisav", 0.1, {.pade_degree = 6}), "");
  EXPECT_EQ(words_on_work("sav", 0.1), "");
}

TEST(SparseWork, MoreThanAMillionKrylovSubstepsAreRefused) {
  const System system = find_backend("sparse").system(fast_and_slow(), {});
  const auto phi = system.make_phi();
  const PhiRows rows{.rows = {PhiRow{}}};
  EXPECT_NO_THROW(phi->map(rows, 0.9));
  try {
    phi->map(rows, 1.1);
    FAIL();
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("h = 1.1 of the sparse backend would take 1.1e+06 Krylov substeps"), std::string::npos) << text;
    EXPECT_NE(text.find("h ≤ 1 would do"), std::string::npos) << text;
  }
}

// Padé factors of degree 6 in one part, at hω = 10⁶: slow motion and the law are as they were.
TEST(SparseWork, PadeFactorsOfOneDegreeServeEveryStep) {
  const Problem problem = fast_and_slow();
  Simulation simulation(problem,
                        {.method = "seisav", .backend = "sparse", .backend_options = {.sparse = {.pade_degree = 6}}});
  double worst_rise = 0;
  EnergyReading before = simulation.stepper().energy(simulation.state());
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(simulation.stepper().step(simulation.state(), 0.1).solved());
    const EnergyReading now = simulation.stepper().energy(simulation.state());
    worst_rise = std::max(worst_rise, (now.modified - before.modified) / now.modified_round_off);
    before = now;
  }
  EXPECT_LE(worst_rise, 1);
  EXPECT_NEAR(simulation.physical()[1], std::cos(10.0) + 0.3 * std::sin(10.0), 1e-13);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
