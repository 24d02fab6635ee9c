// Nanoseconds per step of every method on every backend, for the paper's problems and larger grids.
#include <seiche/config/simulation.hpp>
#include <seiche/core/error.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/problem/alpha_fpu.hpp>
#include <seiche/problem/gkdv.hpp>
#include <seiche/problem/klein_gordon.hpp>

#include <benchmark/benchmark.h>

#include <string>

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
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
