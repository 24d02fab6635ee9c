// The energy books of a finished run, recomputed from its files alone.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace seiche {

struct AuditEntry {
  enum class Verdict { confirmed, contradicted, not_checked };
  std::string claim;
  Verdict verdict;
  std::string evidence;  // the numbers, or why it was not checked
};

struct Audit {
  std::vector<AuditEntry> entries;
  bool confirms() const;  // nothing is contradicted, and something confirmed
};

// Reads case.toml, energy.csv, solution.h5, final.txt and summary.json of `directory`, or of an ensemble members.csv
// and finals.csv beside case, energies and summary; H is evaluated anew by the dense or the modal backend from states
// in the files. Throws Error where a file is missing or no file of a run.
Audit audit(const std::filesystem::path& directory);

std::string to_string(AuditEntry::Verdict verdict);  // "confirmed", "contradicted", "not checked"

}  // namespace seiche
