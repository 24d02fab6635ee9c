// All integrators on one problem, from coarse to fine.
#pragma once

#include <bench/work_precision/measure.hpp>
#include <bench/work_precision/options.hpp>

#include <vector>

namespace seiche::bench {

struct ProblemResult {
  TestProblem test;
  std::string reference = {};  // how it was computed
  double reference_difference = 0;
  bool law_holds = false;  // H of the exact solution never grows
  std::string law_reason = {};
  std::vector<Row> rows = {};
};

// Level by level, with the integrators of one level timed in turn. One that is exact enough, whose next run is expected
// above the cap, or that has used its share of the time, takes no finer level.
ProblemResult sweep(const std::string& problem, const std::vector<Peer>& peers, const Options& options);

}  // namespace seiche::bench
