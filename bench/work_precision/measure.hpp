// One run: what it costs, how far off it ends, and whether its energy ever rose.
#pragma once

#include <bench/work_precision/judge.hpp>
#include <bench/work_precision/reference.hpp>
#include <bench/work_precision/row.hpp>

#include <vector>

namespace seiche::bench {

// Everything that a row needs beside the run.
struct Subject {
  const TestProblem& test;
  const Judge& judge;
  const Reference& reference;
};

// A run that takes part in a round, with its times so far.
struct Contestant {
  Row row;
  std::unique_ptr<Run> run;
  std::vector<double> seconds = {};
};

// Sets the run up, looks at its energy along the way (untimed), and integrates once in one go for error and cost: `row`
// is complete but for the median. Gives up with Status::skipped where it takes longer than `cap_seconds`.
Contestant examine(const Subject& subject, const Peer& peer, double parameter, double cap_seconds);

// How often a run of so many seconds is timed, if short ones are timed `repeats` times.
int timed_runs(double seconds, int repeats);

// Times all of them in turn, A B … A B …, that often each, and sets the medians.
void time_in_turn(std::vector<Contestant>& contestants, double t_end, int repeats);

}  // namespace seiche::bench
