// The audit of a folder that holds an ensemble.
#pragma once

#include <seiche/config/case/run_spec.hpp>
#include <seiche/study/audit/audit.hpp>

#include <filesystem>

namespace seiche {

// Throws Error as `audit` does.
Audit audit_ensemble(const std::filesystem::path& directory, const RunSpec& spec);

}  // namespace seiche
