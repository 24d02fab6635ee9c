// What a potential by a formula costs beside the same one in C++, in turns on 4096 points: gradients alone, and whole
// steps.
#include <seiche/config/custom/custom_problem.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/potential/formula_potential.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/nls.hpp>
#include <seiche/problem/sine_gordon.hpp>
#include <seiche/simulation/simulation.hpp>

#include <benchmark/benchmark.h>

#include "turns.hpp"

#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace {

using namespace seiche;

constexpr Index points = 4096;

struct Pair {
  std::string name;
  Problem built_in, written;
};

GridOptions line() { return {.points = {points}, .length = {0.1 * static_cast<double>(points)}}; }

Problem write_down(const std::string& H, const std::vector<std::string>& fields) {
  Problem p = custom_problem(
      {.fields = fields,
       .grid = line(),
       .H = H,
       .D = fields.front() == "u" ? FormulaTable{{"0", "0"}, {"0", "0.1"}} : FormulaTable{{"0.1", "0"}, {"0", "0.1"}}});
  for (Index i = 0; i < p.size(); ++i) p.initial[i] = 0.5 * std::sin(0.01 * static_cast<double>(i));
  return p;
}

std::vector<Pair> pairs() {
  std::vector<Pair> list = {
      {"polynomial", klein_gordon({.grid = line(), .alpha = 1.0, .gamma = constant_rate(0.1)}),
       write_down("v^2/2 + 0.04/2*u_x^2 + 0.1*u^2 + u^4/4", {"u", "v"})},
      {"polynomial_of_two_fields", nls({.grid = line(), .gamma = constant_rate(0.1)}),
       // The last term keeps it from being seen as a power of |ψ|².
       write_down("(p_x^2 + q_x^2)/4 - (p^2 + q^2)^2/4 + 1e-9*p^4", {"p", "q"})},
      {"sine", sine_gordon({.grid = line(), .gamma = constant_rate(0.1)}),
       write_down("v^2/2 + u_x^2/2 + 1 - cos(u)", {"u", "v"})},
  };
  for (Pair& pair : list) pair.built_in.initial = pair.written.initial;
  return list;
}

template <class A, class B>
void report(benchmark::State& state, const A& built_in, const B& written) {
  std::vector<double> taken;
  for (auto _ : state) {
    taken = bench::median_seconds({built_in, written});
    state.SetIterationTime(taken[1]);
  }
  state.counters["built_in_ns"] = 1e9 * taken[0] / points;  // per point
  state.counters["written_ns"] = 1e9 * taken[1] / points;
  state.counters["ratio"] = taken[1] / taken[0];
}

void gradient_cost(benchmark::State& state, const Pair& pair) {
  const auto one = [](const Problem& p, std::vector<double>& out) {
    const auto begin = p.initial.data() + p.potential_field * p.grid.unknowns();
    const std::span<const double> u(begin, out.size());
    benchmark::DoNotOptimize(p.potential->value_and_gradient(u, out));
  };
  std::vector<double> out(static_cast<std::size_t>(pair.built_in.potential->fields() * points));
  report(
      state, [&] { one(pair.built_in, out); }, [&] { one(pair.written, out); });
}

void step_cost(benchmark::State& state, const Pair& pair, const std::string& method) {
  constexpr double h = 1.0 / 256;
  // How many sweeps a step takes changes with time, and the faster of two would go further.
  constexpr int restart_after = 32;
  const auto steps_of = [&](const Problem& problem) {
    return [simulation = std::make_shared<Simulation>(problem, SimulationOptions{.method = method, .backend = "modal"}),
            taken = 0]() mutable {
      if (++taken % restart_after == 0) simulation->restart();
      simulation->step(h);
    };
  };
  report(state, steps_of(pair.built_in), steps_of(pair.written));
}

[[maybe_unused]] const bool registered = [] {
  for (const Pair& pair : pairs()) {
    const auto measured = [](benchmark::internal::Benchmark* bench) {
      bench->UseManualTime()->Iterations(1)->Unit(benchmark::kMicrosecond);
    };
    measured(benchmark::RegisterBenchmark(("formula/gradient/" + pair.name).c_str(), gradient_cost, pair));
    for (const std::string method : {"seisav", "savf", "egc4"})
      measured(benchmark::RegisterBenchmark(("formula/" + method + "/" + pair.name).c_str(), step_cost, pair, method));
  }
  return true;
}();

}  // namespace
