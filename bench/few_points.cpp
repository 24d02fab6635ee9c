// A step on few points beside the same one written for them alone, and beside the same one on other backends, in turns.
#include <seiche/core/base/error.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/simulation/simulation.hpp>

#include <benchmark/benchmark.h>

#include "peers/dense_step.hpp"
#include "turns.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace seiche;

constexpr double h = 1.0 / 256, kappa = 0.04, omega_squared = 0.2, rate = 0.1, dx = 0.1;

// Both are the same solution, or what they take says nothing.
void require_same(Simulation& simulation, bench::DenseStep& by_hand) {
  constexpr int steps = 256;
  for (int n = 0; n < steps; ++n) {
    if (!simulation.step(h).solved()) throw Error("a step failed");
    by_hand.step();
  }
  const Vector z = simulation.system().space->physical(simulation.state().z);
  const std::vector<double> other = by_hand.state();
  const Eigen::Map<const Vector> w(other.data(), std::ssize(other));
  if (!((z - w).cwiseAbs().maxCoeff() <= 1e-11 * z.cwiseAbs().maxCoeff()))
    throw Error("the step by hand is another one: the states differ by {:.3g}", (z - w).cwiseAbs().maxCoeff());
}

Problem line(Index points) {
  return klein_gordon({.grid = {.points = {points}, .length = {dx * static_cast<double>(points)}},
                       .kappa = kappa,
                       .omega_squared = omega_squared,
                       .alpha = 1.0,
                       .gamma = constant_rate(rate)});
}

constexpr int restart_after = 12800;  // steps, before the energy has gone

void few_points(benchmark::State& state, Index points, const std::string& backend) {
  const Problem problem = line(points);
  Simulation simulation(problem, {.method = "seisav", .backend = backend});
  const auto by_hand = bench::dense_step({.columns = static_cast<std::size_t>(points),
                                          .dx = dx,
                                          .stiffness = kappa,
                                          .mass_squared = omega_squared,
                                          .strength = 1.0,
                                          .gamma = rate,
                                          .initial = {problem.initial.begin(), problem.initial.end()}},
                                         h);
  require_same(simulation, *by_hand);
  simulation.restart();
  by_hand->restart();
  int taken = 0, taken_by_hand = 0;
  std::vector<double> time;
  for (auto _ : state) {
    time = bench::median_seconds({[&] {
                                    if (++taken % restart_after == 0) simulation.restart();
                                    simulation.step(h);
                                  },
                                  [&] {
                                    if (++taken_by_hand % restart_after == 0) by_hand->restart();
                                    by_hand->step();
                                  }});
    state.SetIterationTime(time[0]);
  }
  state.counters["by_hand_ns"] = 1e9 * time[1];
  state.counters["more_ns"] = 1e9 * (time[0] - time[1]);
  state.counters["step/by_hand"] = time[0] / time[1];
}

// What `auto` chooses by.
void dense_beside(benchmark::State& state, Index points, const std::string& method) {
  const std::vector<std::string> backends = {"dense", "modal", "sparse"};
  std::vector<std::unique_ptr<Simulation>> simulations;
  std::vector<std::function<void()>> contestants;
  for (const std::string& backend : backends) {
    simulations.push_back(
        std::make_unique<Simulation>(line(points), SimulationOptions{.method = method, .backend = backend}));
    contestants.emplace_back([simulation = simulations.back().get(), taken = 0]() mutable {
      if (++taken % restart_after == 0) simulation->restart();
      simulation->step(h);
    });
  }
  std::vector<double> time;
  for (auto _ : state) {
    time = bench::median_seconds(contestants);
    state.SetIterationTime(time[0]);
  }
  for (std::size_t i = 1; i < backends.size(); ++i) state.counters["dense/" + backends[i]] = time[0] / time[i];
}

[[maybe_unused]] const bool registered = [] {
  for (const std::string method :
       {"seisav", "savf", "seavf", "seilm", "egc4", "egc6", "etdrk4", "crkn4", "crkn6", "strang_exact"})
    for (const Index points : {4, 8, 12, 16, 20, 24, 32, 64})
      benchmark::RegisterBenchmark(("dense_beside/" + method + "/N=" + std::to_string(points)).c_str(), dense_beside,
                                   points, method)
          ->UseManualTime()
          ->Iterations(1);
  for (const std::string backend : {"dense", "modal"})
    for (const Index points : {4, 8, 20, 64})
      benchmark::RegisterBenchmark(("few_points/seisav/" + backend + "/N=" + std::to_string(points)).c_str(),
                                   few_points, points, backend)
          ->UseManualTime()
          ->Iterations(1);
  return true;
}();

}  // namespace
