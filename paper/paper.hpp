// All of the paper's experiments in one run: examples, side studies, verdicts.
#pragma once

#include <paper/results.hpp>
#include <seiche/study/reference.hpp>

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace seiche {

struct PaperOptions {
  bool quick = false;  // shorter runs, the same figures and verdicts
  ReferenceKind reference = ReferenceKind::fehlberg78;
  int threads = 2;                                                        // of the error runs; timing runs are alone
  std::function<void(double done, std::string_view what)> progress = {};  // done: 0 … 1
  const std::atomic<bool>* stop = nullptr;
};

// When stopped, returns what was finished, without verdicts.
PaperResults run_paper(const PaperOptions& options = {});

// CSV files, one per panel, below `directory`: data/<example>_errors.csv, _energy.csv, _energy_errors.csv,
// data/<side study>.csv, verdicts.csv. Each appears whole or not at all.
void write_results(const PaperResults& results, const std::filesystem::path& directory);

// One document for `seiche paper --json`: everything but the curves over time.
std::string paper_json(const PaperResults& results);

}  // namespace seiche
