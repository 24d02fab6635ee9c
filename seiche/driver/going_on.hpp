// A run or an ensemble that goes on in its folder: from which checkpoint, and with which case.
#pragma once

#include <seiche/driver/case_folder.hpp>
#include <seiche/record/saved_run.hpp>

#include <filesystem>
#include <memory>
#include <optional>

namespace seiche {

struct GoingOn {
  std::unique_ptr<CaseFolder> folder;
  Checkpoint from;
  RunSpec spec;                        // that of the checkpoint, or with another end
  std::optional<double> new_end = {};  // which is this
};

// From the newest checkpoint in `folder` that is whole and fits the files beside it, to `t_end` or else to where its
// case ends. Nothing on the disk is changed. Throws Error where there is no such checkpoint, and for an end that
// cannot be.
GoingOn going_on(const std::filesystem::path& folder, std::optional<double> t_end, const RunCaseOptions& options);

}  // namespace seiche
