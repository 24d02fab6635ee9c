// seiche run for a case with [ensemble].
#pragma once

#include "command_line.hpp"

#include <seiche/config/case/run_spec.hpp>

namespace seiche::cli {

struct EnsembleRunOptions {
  int threads = 1;
  bool restart = false;  // begin anew where a run did not finish
  bool json = false;
  bool quiet = false;
};

// Leaves case.toml, members.csv, energy.csv (statistics of H over the members that run), finals.csv and summary.json.
// Fails if any member failed; what the others computed is on disk.
ExitCode run_ensemble_case(const RunSpec& spec, const EnsembleRunOptions& options);

}  // namespace seiche::cli
