// mpiexec -n P mpi_ranks_check: on P processes of MPI a run has the bits that each of them computes alone.
//                              --time METHOD POINTS: milliseconds that a step takes on a square of so many points
//                              --exchange NUMBERS: microseconds of an exchange of so many with each other process
//                              --sum: microseconds of a sum over all processes
//                              --fail: the first process fails
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/function_ref.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/mpi/mpi_processes.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/simulation/simulation.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace seiche;

Problem wave(std::vector<long> points, std::vector<Boundary> boundary) {
  Problem p = klein_gordon({.grid = {.points = std::move(points), .length = {3.0}, .boundary = std::move(boundary)},
                            .alpha = 1.0,
                            .gamma = constant_rate(0.2)});
  for (Index i = 0; i < p.size(); ++i) p.initial[i] = std::sin(1.3 * static_cast<double>(i + 1));
  return p;
}

// Throws Error where this process holds other numbers than it computes alone.
void compare(const Problem& problem, const std::string& method, const Ranks& ranks) {
  Simulation alone(problem, {.method = method, .backend = "modal"});
  const Problem part = part_of(problem, ranks.here());
  Simulation together(part, {.method = method, .backend = "modal", .backend_options = {.ranks = &ranks}});
  for (int n = 0; n < 5; ++n) {
    alone.step(0.05);
    together.step(0.05);
  }
  if (alone.energy().H != together.energy().H)
    throw Error("{}: H = {} on {} processes, and {} on one", method, together.energy().H, ranks.here().count,
                alone.energy().H);
  Problem expected = problem;
  expected.initial = alone.physical();
  const Vector mine = together.physical();
  if (mine != part_of(expected, ranks.here()).initial)
    throw Error("{}: other bits on {} processes than on one", method, ranks.here().count);
}

// Milliseconds of an action: the least of several turns of so many.
double milliseconds(int count, FunctionRef<void()> action) {
  double least = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < 10; ++turn) {
    const auto begin = std::chrono::steady_clock::now();
    for (int n = 0; n < count; ++n) action();
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begin;
    least = std::min(least, taken.count() / count);
  }
  return least;
}

double milliseconds_of_a_step(const std::string& method, long points, const Ranks& ranks) {
  const Problem part = part_of(wave({points, points}, {Boundary::periodic}), ranks.here());
  Simulation simulation(part, {.method = method, .backend = "modal", .backend_options = {.ranks = &ranks}});
  return milliseconds(8, [&] { simulation.step(0.001); });
}

double microseconds_of_an_exchange(Index numbers, const Ranks& ranks) {
  const std::vector<Index> counts(static_cast<std::size_t>(ranks.here().count), numbers);
  const std::vector<double> from(counts.size() * static_cast<std::size_t>(numbers), 1.0);
  std::vector<double> to(from.size());
  return 1000 * milliseconds(100, [&] { ranks.exchange(from, counts, to, counts); });
}

double microseconds_of_a_sum(const Ranks& ranks) {
  double number = 0;
  return 1000 * milliseconds(1000, [&] { ranks.sum({&number, 1}); });
}

}  // namespace

int main(int count, char** arguments) {
  const std::unique_ptr<Processes> processes(seiche_mpi_processes());
  try {
    const Ranks* const ranks = &processes->ranks();
    const std::vector<std::string> words(arguments + 1, arguments + count);
    const auto say = [&](double time, const char* unit) {
      if (ranks->here().index == 0) fmt::print("{:.3f} {} on {} processes\n", time, unit, ranks->here().count);
      return 0;
    };
    if (words.size() == 3 && words[0] == "--time")
      return say(milliseconds_of_a_step(words[1], std::stol(words[2]), *ranks), "ms");
    if (words.size() == 2 && words[0] == "--exchange")
      return say(microseconds_of_an_exchange(std::stol(words[1]), *ranks), "µs");
    if (words == std::vector<std::string>{"--sum"}) return say(microseconds_of_a_sum(*ranks), "µs");
    if (words == std::vector<std::string>{"--fail"}) {
      if (ranks->here().index == 0) throw Error("process 0 fails, and the others wait for it");
      double waits = 0;
      ranks->max({&waits, 1});
    }
    using enum Boundary;
    for (const std::string method : {"seisav", "seilm", "egc4", "seavf"}) {
      compare(wave({20, 14}, {periodic}), method, *ranks);
      compare(wave({9, 12}, {dirichlet, neumann}), method, *ranks);
      compare(wave({8, 7, 6}, {periodic}), method, *ranks);
    }
    if (ranks->here().index == 0) fmt::print("the same bits on {} processes\n", ranks->here().count);
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    processes->end_all(1);
  }
}
