// Errors, orders, energies and cost of methods at several step sizes, against one reference.
#pragma once

#include <seiche/simulation/simulation.hpp>
#include <seiche/study/reference.hpp>
#include <seiche/study/results.hpp>
#include <seiche/study/timing.hpp>

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace seiche {

struct ConvergeOptions {
  double t_end = 1.0;
  std::string backend = "auto";
  BackendOptions backend_options = {};
  MethodOptions method_options = {};  // each method takes those that mean something to it
  ReferenceOptions reference = {};
  bool timed = true;
  TimingOptions timing = {};
  int threads = 1;                          // of the error runs; timing runs are alone
  const std::atomic<bool>* stop = nullptr;  // ends the study early: runs that were cut short say so in `failure`
};

struct Convergence {
  std::string problem;
  std::string reference;  // what the errors are measured against
  double reference_error = 0.0;
  std::vector<StudyRow> rows;  // method by method, large h to small
};

// Throws Error for a method that does not exist or does not apply; a run that fails is a row with its `failure`.
Convergence converge(const Problem& problem, const std::vector<std::string>& methods, std::vector<double> step_sizes,
                     const ConvergeOptions& options);

// ---- The parts, for studies of their own

// One method with its options, under the name it has in tables and legends.
struct Contender {
  std::string label;
  SimulationOptions options;
};

// What a run leaves beside its row.
struct EnergyRecord {
  std::vector<double> t, H, error;  // thinned: every `stride` steps and the last
  double max_modified_gap = 0.0;    // max_n |H̃(zⁿ) − H(zⁿ)|
};

struct RunRequest {
  const Problem* problem = nullptr;
  Contender contender;
  double h = 0.0;
  double t_end = 0.0;
  std::size_t record_points = 0;  // 0: no record
};

struct RunOutcome {
  StudyRow row;
  EnergyRecord record;
};

// work(i) for i = 0, …, count − 1, on this thread and as many others as make `threads`.
void in_threads(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

// Runs that do not depend on each other, on up to `threads` threads, in the order of the requests; not timed.
std::vector<RunOutcome> measure(const std::vector<RunRequest>& requests, const Reference& reference, int threads,
                                const std::atomic<bool>* stop = nullptr);

MethodOptions options_for(std::string_view method, const MethodOptions& options);
// `rows`: for each contender, in their order, one per step size. Runs that failed stay without a time.
void add_timings(std::vector<StudyRow>& rows, const Problem& problem, const std::vector<Contender>& contenders,
                 double t_end, const TimingOptions& options);
void fill_orders(std::vector<StudyRow>& rows);  // needs each method's rows together, large h to small

// The reference in words, with a warning where its error is more than 1/100 of the smallest in `rows`.
std::string described(const Reference& reference, const std::vector<StudyRow>& rows);

// ---- Output

std::string converge_json(const Convergence& study);   // one document, as `seiche converge --json`
std::string converge_table(const Convergence& study);  // for a terminal

}  // namespace seiche
