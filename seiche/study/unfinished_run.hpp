// A run or an ensemble that goes on, or was killed, as its newest checkpoint has it.
#pragma once

#include <seiche/config/case/run_spec.hpp>
#include <seiche/record/saved_run.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace seiche {

struct UnfinishedRun {
  SavedRun saved;
  RunSpec spec;
  bool is_running = false;         // a program holds its folder
  std::filesystem::path energies;  // energy.csv, as long as saved.energies.file says; rows behind that may be torn

  std::string how_far() const;  // "still running, up to t = 3.5", or "not finished, up to t = 3.5"
};

// None where the folder tells of an end, or holds no checkpoint. Throws Error where no checkpoint can be read, and of a
// run that goes on and has not written one.
std::optional<UnfinishedRun> unfinished_run(const std::filesystem::path& directory);

}  // namespace seiche
