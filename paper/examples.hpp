// The paper's numerical examples with all methods that apply: errors, orders, energies and cost.
#pragma once

#include <paper/evidence.hpp>
#include <paper/results.hpp>
#include <seiche/core/problem.hpp>
#include <seiche/study/converge.hpp>

#include <atomic>
#include <string>
#include <vector>

namespace seiche {

struct PaperExample {
  std::string key, title, parameters;
  Problem problem;
  double t_end;
  std::vector<double> step_sizes;  // large to small
};

// Examples 1, 2.1, 2.2, 3, and 3 with μ = 0.1; `quick` ends them earlier.
std::vector<PaperExample> paper_examples(bool quick);

// The eight schemes of the paper's comparison, in the order of its legends.
const std::vector<std::string>& paper_methods();

struct ExampleOptions {
  ReferenceOptions reference = {};
  TimingOptions timing = {};
  double seavf_end = 1.0;  // how long the paper's reference is followed, a multiple of its step
  int threads = 2;         // of the error runs
  const std::atomic<bool>* stop = nullptr;
};

struct ExampleStudy {
  ExampleResult result;
  ExampleEvidence evidence;
};
// Everything but the times; may run on several threads at once.
ExampleStudy study_errors(const PaperExample& example, const ExampleOptions& options);
// The times of its runs, which nothing else should disturb.
void add_times(ExampleStudy& study, const PaperExample& example, const TimingOptions& options);

}  // namespace seiche
