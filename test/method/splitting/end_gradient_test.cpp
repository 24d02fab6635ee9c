// Splittings that end with a kick: its gradient begins the next step and tells V.
#include <test/support/cases.hpp>

#include <gtest/gtest.h>
#include <seiche/core/control/archive.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/method/methods.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/sine_gordon.hpp>
#include <seiche/simulation/simulation.hpp>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

struct Work {
  double gradients, values;  // of V, per step
};

Work work_per_step(const Problem& problem, const std::string& method, const std::string& backend) {
  Simulation simulation(problem, {.method = method, .backend = backend});
  constexpr int steps = 20;
  simulation.step(1.0 / 64);  // nothing is known of the state before it
  const Potential::Counts before = simulation.system().potential->counts();
  for (int n = 0; n < steps; ++n) EXPECT_TRUE(simulation.step(1.0 / 64).solved());
  const Potential::Counts after = simulation.system().potential->counts();
  return {static_cast<double>(after.gradients - before.gradients) / steps,
          static_cast<double>(after.values - before.values) / steps};
}

const std::vector<std::pair<std::string, int>> gradients_of_methods = {{"strang_exact", 1},
                                                                       {"crkn4", 6},
                                                                       {"crkn6", 11}};

// With γ = 0 the projection moves every step to the H of the start, along the ray through the solution, on which a
// homogeneous V and its gradient are known from one value.
TEST(EndGradient, AStepWithItsLawTakesOneGradientForEachFlowAndNoOtherValueOfV) {
  const GridOptions line{.points = {64}, .length = {6.4}};
  const std::vector<Problem> problems = {klein_gordon({.grid = line, .alpha = 1.0, .gamma = constant_rate(0.1)}),
                                         klein_gordon({.grid = line, .alpha = 1.0, .gamma = constant_rate(0)}),
                                         sine_gordon({.grid = line, .gamma = constant_rate(0.1)})};
  for (const Problem& problem : problems)
    for (const std::string backend : {"modal", "dense"})
      for (const auto& [method, gradients] : gradients_of_methods) {
        const Work work = work_per_step(problem, method, backend);
        // The interval of crkn4 and crkn6 may ask for a point below what they computed, now and then.
        EXPECT_EQ(work.gradients, gradients) << problem.name << " " << method << " " << backend;
        EXPECT_EQ(work.values, 0) << problem.name << " " << method << " " << backend;
      }
}

// Whatever the projection did to the state, halved steps and steps that were replaced among them.
TEST(EndGradient, WhatIsRememberedIsTheGradientOfTheState) {
  int compared = 0;
  for (const auto& [name, problem] : all_cases()) {
    for (const auto& [method, gradients] : gradients_of_methods) {
      if (!applies(method, problem)) continue;
      Simulation simulation(problem, {.method = method});
      const Space& space = *simulation.system().space;
      Vector gradient = Vector::Zero(space.size());
      int known = 0;
      for (const double h : {1.0 / 64, 1.0 / 16, 1.0, 0.25, 4.0, 1.0 / 8})
        for (int n = 0; n < 10 && simulation.step(h).solved(); ++n) {
          const State& s = simulation.state();
          if (s.history_h == 0) continue;
          ++known;
          simulation.system().potential->gradient(s.z, gradient);
          EXPECT_LE(space.norm(gradient - s.history.front()), 1e-13 * (1 + space.norm(gradient)))
              << name << " " << method << " h = " << h;
        }
      compared += known > 0 ? 1 : 0;
    }
  }
  EXPECT_GE(compared, 30);
}

// As before a method kept any.
TEST(EndGradient, ACheckpointWithoutItGoesOn) {
  Simulation simulation(klein_gordon_case(0.1, 1.0), {.method = "crkn4"});
  simulation.step(1.0 / 8);
  State written = simulation.state();
  written.history.clear();
  written.history_h = 0;
  std::string bytes;
  Archive writer([&](std::string_view piece) { bytes += piece; });
  written.archive(writer);
  State read = simulation.state();
  Archive reader(bytes);
  read.archive(reader);
  EXPECT_EQ(read.history.size(), 1U);
  EXPECT_EQ(read.history_h, 0);
  EXPECT_TRUE(simulation.stepper().step(read, 1.0 / 8).solved());
}

// A state that starts with nothing known goes on as one that remembers, to round-off.
TEST(EndGradient, RememberingChangesNoSolution) {
  const Problem problem = klein_gordon_case(0.1, 1.0);
  for (const auto& [method, gradients] : gradients_of_methods) {
    Simulation remembering(problem, {.method = method}), forgetting(problem, {.method = method});
    for (int n = 0; n < 100; ++n) {
      remembering.step(1.0 / 8);
      forgetting.stepper().restart(forgetting.state());
      forgetting.step(1.0 / 8);
    }
    EXPECT_LE((remembering.physical() - forgetting.physical()).lpNorm<Eigen::Infinity>(), 1e-12) << method;
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
