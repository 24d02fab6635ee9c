// Nanoseconds per step of every method on every backend, for the paper's problems and larger grids.
#include <seiche/config/simulation.hpp>
#include <seiche/core/error.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/problem/alpha_fpu.hpp>
#include <seiche/problem/gkdv.hpp>
#include <seiche/problem/klein_gordon.hpp>

#include <benchmark/benchmark.h>

#include "floor.hpp"

#include <string>
#include <vector>

namespace {

using seiche::Index;
using seiche::Problem;

Problem klein_gordon(Index points) {  // the paper's Δx = 0.1, defocusing so that long runs stay bounded
  return seiche::klein_gordon({.grid = {.points = {points}, .length = {0.1 * static_cast<double>(points)}},
                               .alpha = 1.0,
                               .gamma = seiche::constant_rate(0.1)});
}

Problem alpha_fpu(Index points) {
  return seiche::alpha_fpu(
      {.length = 0.1 * static_cast<double>(points), .points = points, .gamma = seiche::constant_rate(0.5)});
}

Problem gkdv(Index points) {
  return seiche::gkdv(
      {.length = 0.5 * static_cast<double>(points), .points = points, .mu = seiche::constant_rate(0.5)});
}

void step_cost(benchmark::State& state, const Problem& problem, const std::string& method, const std::string& backend) {
  constexpr double h = 1.0 / 256;
  constexpr int restart_after = 12800;  // the paper's run: T = 50
  seiche::Simulation simulation(problem, {.method = method, .backend = backend});
  int steps = 0;
  simulation.step(h);  // builds the propagators
  for (auto _ : state) {
    if (!simulation.step(h).solved()) state.SkipWithError("a step failed");
    if (++steps % restart_after == 0) simulation.restart();
  }
  state.SetItemsProcessed(state.iterations() * problem.grid.unknowns());  // items: grid points
}

// A step of seisav, four transforms and a triad in turns, on a grid that is periodic along every axis: nanoseconds per
// point, and the ratio of the step to its own transforms and to those of FFTW.
void floor_cost(benchmark::State& state, const Problem& problem, int threads) {
  const double per_point = 1e9 / static_cast<double>(problem.grid.unknowns());
  seiche::bench::Floor floor;
  for (auto _ : state) {
    floor = seiche::bench::measure_floor(problem, {.threads = threads});
    state.SetIterationTime(floor.step);
  }
  state.counters["ns_per_point"] = floor.step * per_point;
  state.counters["own_FFTs"] = floor.transforms * per_point;
  state.counters["FFTW"] = floor.fftw * per_point;
  state.counters["triad"] = floor.triad * per_point;
  state.counters["step/own"] = floor.step / floor.transforms;
  state.counters["step/FFTW"] = floor.step / floor.fftw;
}

void add_floor(const std::vector<Index>& points, int threads) {
  std::vector<double> length;
  std::string label = "floor/seisav";
  for (const Index n : points) {
    length.push_back(0.1 * static_cast<double>(n));
    label += "/" + std::to_string(n);
  }
  if (threads > 1) label += "/threads:" + std::to_string(threads);
  const Problem problem = seiche::klein_gordon(
      {.grid = {.points = points, .length = length}, .alpha = 1.0, .gamma = seiche::constant_rate(0.1)});
  benchmark::RegisterBenchmark(label.c_str(), floor_cost, problem, threads)->UseManualTime()->Iterations(1);
}

void add(const std::string& name, const Problem& problem, Index points, const std::string& method,
         const std::string& backend) {
  try {
    const seiche::Simulation applies(problem, {.method = method, .backend = backend});
  } catch (const seiche::Error&) {
    return;
  }
  const std::string label = name + "/" + method + "/" + backend + "/N=" + std::to_string(points);
  benchmark::RegisterBenchmark(label.c_str(), step_cost, problem, method, backend);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  for (const seiche::MethodEntry& method : seiche::methods()) {
    for (const seiche::BackendEntry& backend : seiche::backends()) {
      const std::string m(method.name);
      const std::string b(backend.name);
      add("klein_gordon", klein_gordon(20), 20, m, b);
      add("alpha_fpu", alpha_fpu(20), 20, m, b);
      add("gkdv", gkdv(20), 20, m, b);
    }
  }
  for (const Index points : {8, 16, 64, 512, 4096, 65536}) {
    if (points <= 64) add("klein_gordon", klein_gordon(points), points, "seisav", "dense");
    add("klein_gordon", klein_gordon(points), points, "seisav", "modal");
  }
  for (const Index points : {20, 64, 512, 4096, 65536, 1 << 20}) add_floor({points}, 1);
  for (const int threads : {1, 2})
    for (const std::vector<Index>& points : {std::vector<Index>{256, 256}, {1024, 1024}, {128, 128, 128}})
      add_floor(points, threads);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
