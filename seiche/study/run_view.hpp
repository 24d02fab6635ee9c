// A run for those who look at it: what it left at its end, or what its newest checkpoint vouches for.
#pragma once

#include <seiche/study/energy_history.hpp>
#include <seiche/study/run_files.hpp>

#include <filesystem>

namespace seiche {

struct RunView {
  RunFiles run;
  EnergyHistory history;
};

// Throws Error where the folder holds neither, saying what is missing.
RunView view_of_run(const std::filesystem::path& directory);

// Throws Error where a run that had not ended has ended since, so that what was made of it is not kept.
void require_still_unfinished(const RunFiles& run);

}  // namespace seiche
