#include <bench/work_precision/seiche_peers.hpp>
#include <bench/work_precision/sweep.hpp>

#include <fmt/format.h>
#include <seiche/study/timing.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace seiche::bench {
namespace {

constexpr int levels = 15;

// One integrator on its way from coarse to fine.
struct Climber {
  Peer peer;
  bool done = false;
  double spent = 0;    // CPU seconds of all that was done with it
  double seconds = 0;  // of the last run, and what it was multiplied by
  double growth = 2;
  double best_error = INFINITY;
  int without_progress = 0;
};

double parameter_of(const Climber& climber, int level, int coarsest) {
  if (climber.peer.sweep == Sweep::step_size) return std::ldexp(1.0, -(coarsest + level));
  constexpr int loosest = 2;  // decades
  return std::pow(10.0, -(loosest + level));
}

constexpr double tightest_tolerance = 0.9e-13;  // the reference itself is tighter

void learn(Climber& climber, const Row& row, double floor) {
  if (row.status == Status::skipped) climber.done = true;
  if (row.status != Status::solved) return;
  if (climber.seconds > 0) climber.growth = std::max(row.cpu_seconds / climber.seconds, 1.0);
  climber.seconds = row.cpu_seconds;
  climber.without_progress = row.error < 0.7 * climber.best_error ? 0 : climber.without_progress + 1;
  climber.best_error = std::min(climber.best_error, row.error);
  const bool at_round_off = climber.without_progress >= 2 && climber.best_error < 1e-8;
  climber.done = row.error < floor || at_round_off;
}

// Refuses those that integrate another equation. Looks once, with a coarse parameter: the equation does not depend on
// it.
std::vector<Climber> admitted(const Subject& subject, const std::vector<Peer>& peers, std::vector<Row>& rows) {
  std::vector<Climber> climbers;
  for (const Peer& peer : peers) {
    if (!peer.applies(subject.test.equation)) continue;
    constexpr double any_parameter = 1.0 / 16;
    const std::string refusal = subject.judge.refuses(*peer.make(subject.test.equation, any_parameter));
    if (refusal.empty()) {
      climbers.push_back({.peer = peer, .growth = peer.sweep == Sweep::step_size ? 2.0 : 1.5});
      continue;
    }
    rows.push_back({.problem = subject.test.key,
                    .peer = peer.name,
                    .library = peer.library,
                    .origin = peer.origin,
                    .sweep = peer.sweep,
                    .status = Status::refused,
                    .message = refusal});
    std::fprintf(stderr, "%s: %s is not timed: %s\n", subject.test.key.c_str(), peer.name.c_str(), refusal.c_str());
  }
  return climbers;
}

Row skipped(const Subject& subject, const Climber& climber, double parameter, const std::string& message) {
  return {.problem = subject.test.key,
          .peer = climber.peer.name,
          .library = climber.peer.library,
          .origin = climber.peer.origin,
          .sweep = climber.peer.sweep,
          .parameter = parameter,
          .status = Status::skipped,
          .message = message};
}

}  // namespace

ProblemResult sweep(const std::string& problem, const std::vector<Peer>& peers, const Options& options) {
  ProblemResult result{.test = make_test_problem(problem)};
  const Judge judge(result.test);
  const Reference reference = find_reference(result.test, judge, options.out / "references");
  result.reference = reference.origin;
  result.reference_difference = reference.difference;
  result.law_holds = judge.law().promised;
  result.law_reason = judge.law().reason;
  constexpr double values_per_second = 2e9;  // no right-hand side here is faster
  result.test.equation.most_evaluations =
      std::llround(options.cap_seconds * values_per_second / static_cast<double>(result.test.equation.size()));
  const Subject subject{result.test, judge, reference};

  std::vector<Peer> all;
  for (const Peer& peer : seiche_peers(result.test)) {
    const auto& wanted = options.methods;
    if (wanted.empty() || std::find(wanted.begin(), wanted.end(), peer.name) != wanted.end()) all.push_back(peer);
  }
  all.insert(all.end(), peers.begin(), peers.end());
  std::vector<Climber> climbers = admitted(subject, all, result.rows);

  constexpr double exact_enough = 1e-10;  // a decade below the smallest error of the tables
  const double floor = std::max(3 * reference.difference, exact_enough);
  const double share = options.problem_seconds / static_cast<double>(std::max<std::size_t>(climbers.size(), 1));
  const double begin = thread_cpu_seconds();
  for (int level = 0; level < levels; level += options.quick ? 2 : 1) {
    std::vector<Contestant> contestants;
    std::vector<std::size_t> indices;  // of their climbers
    for (std::size_t i = 0; i < climbers.size(); ++i) {
      Climber& climber = climbers[i];
      const double parameter = parameter_of(climber, level, result.test.coarsest);
      if (climber.done || (climber.peer.sweep == Sweep::tolerance && parameter < tightest_tolerance)) continue;
      const double expected = climber.seconds * climber.growth;
      // Looked at, run once, and then timed.
      const bool too_long = expected > options.cap_seconds;
      const bool too_much = climber.spent + expected * (2 + timed_runs(expected, options.repeats)) > share;
      if (too_long || (level > 0 && too_much)) {
        result.rows.push_back(
            skipped(subject, climber, parameter,
                    too_long
                        ? fmt::format("expected to take {:.2g} s, more than the cap of {:.2g} s", expected,
                                      options.cap_seconds)
                        : fmt::format("expected to take {:.2g} s, several times; of its {:.2g} s {:.2g} s are used",
                                      expected, share, climber.spent)));
        climber.done = true;
        continue;
      }
      const double before = thread_cpu_seconds();
      contestants.push_back(examine(subject, climber.peer, parameter, options.cap_seconds));
      climber.spent += thread_cpu_seconds() - before;
      indices.push_back(i);
    }
    if (contestants.empty()) break;
    time_in_turn(contestants, result.test.equation.t_end, options.repeats);
    for (std::size_t i = 0; i < contestants.size(); ++i) {
      Climber& climber = climbers[indices[i]];
      climber.spent = std::accumulate(contestants[i].seconds.begin(), contestants[i].seconds.end(), climber.spent);
      learn(climber, contestants[i].row, floor);
      result.rows.push_back(contestants[i].row);
    }
    std::fprintf(stderr, "%s: level %d, %zu runs, %.0f s\n", problem.c_str(), level, contestants.size(),
                 thread_cpu_seconds() - begin);
  }
  return result;
}

}  // namespace seiche::bench
