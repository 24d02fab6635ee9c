// A step on few points beside the same one written for them alone, in turns.
#include <seiche/core/base/error.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/simulation/simulation.hpp>

#include <benchmark/benchmark.h>

#include "peers/dense_step.hpp"
#include "turns.hpp"

#include <string>
#include <vector>

namespace {

using namespace seiche;

constexpr double h = 1.0 / 256, kappa = 0.04, omega_squared = 0.2, rate = 0.1;

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

void few_points(benchmark::State& state, Index points, const std::string& backend) {
  const double dx = 0.1;
  const Problem problem = klein_gordon({.grid = {.points = {points}, .length = {dx * static_cast<double>(points)}},
                                        .kappa = kappa,
                                        .omega_squared = omega_squared,
                                        .alpha = 1.0,
                                        .gamma = constant_rate(rate)});
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
  constexpr int restart_after = 12800;  // before the energy has gone
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

[[maybe_unused]] const bool registered = [] {
  for (const std::string backend : {"dense", "modal"})
    for (const Index points : {4, 8, 20, 64})
      benchmark::RegisterBenchmark(("few_points/seisav/" + backend + "/N=" + std::to_string(points)).c_str(),
                                   few_points, points, backend)
          ->UseManualTime()
          ->Iterations(1);
  return true;
}();

}  // namespace
