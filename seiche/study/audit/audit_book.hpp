// What audits of runs and of ensembles share: entries, and energies of states in files.
#pragma once

#include <seiche/core/problem.hpp>
#include <seiche/core/system.hpp>
#include <seiche/output/file/sha256.hpp>
#include <seiche/study/audit/audit.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace seiche {

class AuditBook {
 public:
  using Verdict = AuditEntry::Verdict;

  void add(std::string claim, Verdict verdict, std::string evidence);
  // Confirmed where nothing is in `differences`, which are joined to sentences; else `agreement` is the evidence.
  void add_differences(std::string claim, const std::vector<std::string>& differences, std::string agreement);
  // Confirmed where two numbers lie no further apart than `allowed`; with evidence.
  void compare(std::string claim, double recomputed, double written, double allowed);

  // case.toml, and the files that it names, against the SHA-256 in summary.json.
  void compare_hashes(const std::filesystem::path& directory, const FileHashes& written);

  Audit audit() const { return audit_; }

 private:
  Audit audit_;
};

// "sha256" of the summary of a run, or of an ensemble; none where it has none, or cannot be read.
FileHashes hashes_in(const std::filesystem::path& summary);

// H of physical states, by a backend of its own.
class RecomputedEnergy {
 public:
  explicit RecomputedEnergy(const Problem& problem);
  EnergyTerms of(const Vector& physical);

 private:
  System system_;
  Vector z_;
};

}  // namespace seiche
