// A case with [ensemble], from its description to the folder of files that it leaves.
#pragma once

#include <seiche/driver/ensemble_outcome.hpp>
#include <seiche/driver/run_case.hpp>

namespace seiche {

struct EnsembleCaseResult {
  EnsembleOutcome outcome;
  EnsembleRecord first, last;  // of the statistics
  std::int64_t members = 0;
  double wall_seconds = 0.0;
  std::string summary;  // summary.json
};

// Leaves case.toml, members.csv, energy.csv (statistics of H over the members that run), finals.csv and summary.json in
// `directory`. Throws Error as run_case. Fails if any member failed; what the others computed is on disk.
EnsembleCaseResult run_ensemble_case(RunSpec spec, const std::filesystem::path& directory,
                                     const RunCaseOptions& options = {});
// Leaves the same files with the same numbers as an ensemble that was never stopped.
EnsembleCaseResult resume_ensemble_case(GoingOn from, const RunCaseOptions& options = {});

}  // namespace seiche
