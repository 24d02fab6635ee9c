// Makes the folder of a run that was killed one that can be read as any other.
#pragma once

#include <seiche/output/file/folder.hpp>

#include <string>
#include <vector>

namespace seiche {

struct Recovery {
  std::vector<std::string> saved, lost;  // sentences, in the order of the files
};

// Files that were not finished get their names: energy.csv without a line that was torn off, solution.h5 with the
// times for which everything is there. final.txt, solution.xdmf and summary.json (status "unfinished") are written
// anew where they are missing, or are of an earlier end of a run that went on. `saved_case` is the case of a checkpoint
// in the folder, or "": it takes the place of a case.toml that is missing or cannot be read, or that of before a run
// went on; what was there is kept as case_before_recover.toml. What cannot be read stays as it is. Throws Error where
// the folder holds no run; the caller holds its lock.
Recovery recover(const Folder& folder, const std::string& saved_case = "");

}  // namespace seiche
