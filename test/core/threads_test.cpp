// Threads change how long a step takes, and nothing else.
#include <gtest/gtest.h>
#include <seiche/damping/rates.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/simulation/simulation.hpp>

#include <memory>
#include <thread>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

Vector after_some_steps(const Problem& problem, const std::string& method, int threads) {
  Simulation simulation(problem, {.method = method, .backend = "modal", .backend_options = {.threads = threads}});
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(simulation.step(1.0 / 32).solved());
  Vector all(simulation.state().z.size() + 2);
  all << simulation.state().z, simulation.state().r_squared, simulation.energy().H;
  return all;
}

TEST(Threads, DoNotChangeASingleBitOnAnyGrid) {
  using enum Boundary;
  struct Case {
    std::vector<Index> points;
    std::vector<Boundary> boundary;
  };
  // Large enough for several blocks of modes, of rows and of columns.
  for (const Case& c : {Case{{9000}, {periodic}}, Case{{8401}, {dirichlet}}, Case{{260, 130}, {periodic}},
                        Case{{260, 130}, {dirichlet, neumann}}, Case{{91, 98}, {periodic, dirichlet}},
                        Case{{20, 22, 24}, {periodic}}, Case{{20, 22, 24}, {neumann, periodic, dirichlet}}}) {
    const Problem problem = klein_gordon({.grid = {.points = c.points, .length = {7.0}, .boundary = c.boundary},
                                          .alpha = 1,
                                          .gamma = constant_rate(0.1)});
    for (const char* method : {"seisav", "seavf"}) {
      const Vector one = after_some_steps(problem, method, 1);
      for (const int threads : {2, 3}) EXPECT_EQ(after_some_steps(problem, method, threads), one) << method;
    }
  }
}

// A caller that runs several simulations on threads of its own.
TEST(Threads, SimulationsOnThreadsOfTheCallerAreTheSame) {
  const Problem problem = klein_gordon({.grid = {.points = {64, 64}, .length = {7.0}}, .alpha = 1});
  const Vector expected = after_some_steps(problem, "seisav", 1);
  constexpr int simulations = 4;
  std::vector<std::unique_ptr<Simulation>> all;  // made one by one: FFTW plans on one thread at a time
  for (int i = 0; i < simulations; ++i)
    all.push_back(std::make_unique<Simulation>(
        problem, SimulationOptions{.method = "seisav", .backend = "modal", .backend_options = {.threads = 1 + i % 2}}));
  {
    std::vector<std::jthread> callers;
    for (const auto& simulation : all)
      callers.emplace_back([&simulation] {
        for (int n = 0; n < 4; ++n) simulation->step(1.0 / 32);
      });
  }
  for (const auto& simulation : all) EXPECT_EQ(simulation->state().z, expected.head(simulation->state().z.size()));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
