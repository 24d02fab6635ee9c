// Nanoseconds per member and step of ensembles of 4096 on one thread, and of the same members one after the other.
#include <seiche/damping/rates.hpp>
#include <seiche/ensemble/panel_block.hpp>
#include <seiche/problem/klein_gordon.hpp>

#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

namespace {

using seiche::EnsembleMember;
using seiche::Index;
using seiche::MemberBlock;

constexpr Index members = 4096;
constexpr double h = 1.0 / 256;

// The paper's Δx = 0.1, defocusing; members differ in their initial states alone, or in κ, α and γ as well.
std::vector<EnsembleMember> make_members(Index points, bool vary) {
  const auto problem = [&](double x) {
    return std::make_shared<const seiche::Problem>(
        seiche::klein_gordon({.grid = {.points = {points}, .length = {0.1 * static_cast<double>(points)}},
                              .kappa = 0.04 * (1 + x),
                              .alpha = 1.0 + x,
                              .gamma = seiche::constant_rate(0.1 + 0.1 * x)}));
  };
  const auto shared = problem(0);
  std::vector<EnsembleMember> list;
  for (Index m = 0; m < members; ++m) {
    const double x = static_cast<double>(m) / static_cast<double>(members);
    list.push_back({vary ? problem(x) : shared, (1 + x) * shared->initial});
  }
  return list;
}

void ensemble_cost(benchmark::State& state, Index points, bool vary, const std::string& method, bool side_by_side) {
  const std::vector<EnsembleMember> list = make_members(points, vary);
  std::vector<std::unique_ptr<MemberBlock>> blocks;
  for (Index m = 0; m < members; m += seiche::panel_members) {
    const std::span<const EnsembleMember> part(list.data() + m, static_cast<std::size_t>(seiche::panel_members));
    blocks.push_back(side_by_side ? seiche::make_block(part, {.method = method})
                                  : std::make_unique<MemberBlock>(part, seiche::SimulationOptions{.method = method}));
  }
  // As run_ensemble does between two records: one block after the other, each for some steps.
  constexpr int steps = 16;
  std::int64_t n = 0;
  for (const auto& block : blocks) block->step(1, 0.0, h, h);  // builds what belongs to h
  for (auto _ : state) {
    for (const auto& block : blocks) {
      for (int i = 0; i < steps; ++i) {
        const double t = static_cast<double>(n + i) * h;
        block->step(n + i + 1, t, h, t + h);
      }
    }
    n += steps;
  }
  state.SetItemsProcessed(state.iterations() * members * steps);
  state.counters["per_member_step"] =
      benchmark::Counter(static_cast<double>(members * steps),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  for (const bool vary : {false, true}) {
    for (const char* method : {"seisav", "ssav", "seavf"}) {
      for (const Index points : {Index{20}, Index{64}}) {
        for (const bool side_by_side : {true, false}) {
          if (!side_by_side && vary) continue;
          const std::string name = std::string("klein_gordon/") + method + "/N=" + std::to_string(points) +
                                   (vary ? "/parameters" : "/initial") +
                                   (side_by_side ? "/side_by_side" : "/one_by_one");
          benchmark::RegisterBenchmark(name.c_str(), ensemble_cost, points, vary, method, side_by_side)
              ->Unit(benchmark::kMillisecond);
        }
      }
    }
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
