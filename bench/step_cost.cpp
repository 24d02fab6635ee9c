// Nanoseconds per grid point and step of every method on every backend, beside the step's own transforms and a triad.
#include <seiche/core/base/error.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/problem/alpha_fpu.hpp>
#include <seiche/problem/gkdv.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/simulation/simulation.hpp>

#include <benchmark/benchmark.h>

#include "floor.hpp"
#include "step_beside.hpp"

#include <functional>
#include <string>
#include <vector>

namespace {

using seiche::Index;
using seiche::Problem;
using Points = std::vector<Index>;      // along each axis
using Make = std::function<Problem()>;  // when it is measured: a million points each are many

constexpr double h = 1.0 / 256;

Problem klein_gordon(const Points& points) {  // the paper's Δx = 0.1, defocusing so that long runs stay bounded
  std::vector<double> length;
  for (const Index n : points) length.push_back(0.1 * static_cast<double>(n));
  return seiche::klein_gordon(
      {.grid = {.points = points, .length = length}, .alpha = 1.0, .gamma = seiche::constant_rate(0.1)});
}

Problem alpha_fpu(Index points) {
  return seiche::alpha_fpu(
      {.length = 0.1 * static_cast<double>(points), .points = points, .gamma = seiche::constant_rate(0.5)});
}

Problem gkdv(Index points) {
  return seiche::gkdv(
      {.length = 0.5 * static_cast<double>(points), .points = points, .mu = seiche::constant_rate(0.5)});
}

// A method that solves an equation makes as many transforms as that takes. A backend without transforms has the triad
// alone beside it.
void step_cost(benchmark::State& state, const Make& make, const std::string& method, const std::string& backend) {
  const Problem problem = make();
  const double per_point = 1e9 / static_cast<double>(problem.grid.unknowns());
  seiche::bench::StepBeside cost{};
  for (auto _ : state) {
    cost = seiche::bench::measure_step(problem, method, backend, h);
    state.SetIterationTime(cost.step);
  }
  state.counters["ns_per_point"] = cost.step * per_point;
  state.counters["triad"] = cost.triad * per_point;
  state.counters["step/triad"] = cost.step / cost.triad;
  if (cost.transform_count == 0) return;
  state.counters["FFTs"] = cost.transform_count;
  state.counters["own_FFTs"] = cost.transforms * per_point;
  state.counters["step/own"] = cost.step / cost.transforms;
}

// A step of seisav by both predictors, four transforms and a triad in turns, on a grid that is periodic along every
// axis: nanoseconds per point, and the ratios to the transforms that a step takes, and to four.
void floor_cost(benchmark::State& state, const Points& points, int threads) {
  const Problem problem = klein_gordon(points);
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
  state.counters["by_gradient"] = floor.by_gradient * per_point;
  state.counters["step/two"] = 2 * floor.step / floor.transforms;
  state.counters["step/four"] = floor.step / floor.transforms;
  state.counters["by_gradient/four"] = floor.by_gradient / floor.transforms;
  state.counters["step/by_gradient"] = floor.step / floor.by_gradient;
}

std::string joined(const Points& points, const char* separator) {
  std::string text;
  for (const Index n : points) text += (text.empty() ? "" : separator) + std::to_string(n);
  return text;
}

void add_floor(const Points& points, int threads) {
  std::string label = "floor/seisav/" + joined(points, "/");
  if (threads > 1) label += "/threads:" + std::to_string(threads);
  benchmark::RegisterBenchmark(label.c_str(), floor_cost, points, threads)->UseManualTime()->Iterations(1);
}

bool applies(const Problem& problem, const std::string& method, const std::string& backend) {
  try {
    const seiche::Simulation simulation(problem, {.method = method, .backend = backend});
    return true;
  } catch (const seiche::Error&) {
    return false;
  }
}

void add(const std::string& name, const Make& make, const Points& points, const std::string& backend,
         const std::vector<std::string>& methods) {
  for (const std::string& method : methods) {
    const std::string label = name + "/" + method + "/" + backend + "/N=" + joined(points, "x");
    benchmark::RegisterBenchmark(label.c_str(), step_cost, make, method, backend)->UseManualTime()->Iterations(1);
  }
}

// All methods that apply to a problem of a kind do so whatever its size.
std::vector<std::string> methods_for(const Problem& problem, const std::string& backend) {
  std::vector<std::string> list = seiche::method_names();
  std::erase_if(list, [&](const std::string& method) { return !applies(problem, method, backend); });
  return list;
}

void add_everything() {
  const std::vector<std::string> few = {"seisav", "seavf", "seilm"};  // one of each closure of the paper
  const auto add_grids = [](const std::string& backend, const std::vector<Points>& grids,
                            const std::vector<std::string>& methods) {
    for (const Points& points : grids)
      add(
          "klein_gordon", [points] { return klein_gordon(points); }, points, backend, methods);
  };
  const auto all = [](const std::string& backend) { return methods_for(klein_gordon({20}), backend); };
  add_grids("dense", {{8}, {20}, {64}}, all("dense"));
  add_grids("modal", {{20}, {64}, {512}, {4096}}, all("modal"));
  add_grids("modal", {{1 << 20}, {256, 256}, {1024, 1024}, {64, 64, 64}, {128, 128, 128}}, few);
  add_grids("sparse", {{20}, {512}, {4096}}, all("sparse"));
  add_grids("sparse", {{64, 64}}, few);
  for (const std::string backend : {"dense", "modal", "sparse"}) {
    add(
        "alpha_fpu", [] { return alpha_fpu(20); }, {20}, backend, methods_for(alpha_fpu(20), backend));
    add(
        "gkdv", [] { return gkdv(20); }, {20}, backend, methods_for(gkdv(20), backend));
  }
  for (const Index points : {20, 64, 512, 4096, 65536, 1 << 20}) add_floor({points}, 1);
  for (const int threads : {1, 2})
    for (const Points& points : {Points{256, 256}, {1024, 1024}, {128, 128, 128}}) add_floor(points, threads);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  add_everything();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
