// The folder that a case leaves its files in, from its first file on.
#pragma once

#include <seiche/driver/run_case.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/output/file/folder_lock.hpp>
#include <seiche/output/file/sha256.hpp>
#include <seiche/record/run_folder.hpp>

#include <atomic>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace seiche {

// Made if need be, locked against other runs, emptied of earlier results, and begun with case.toml.
class CaseFolder {
 public:
  // Throws Error where it is in use, holds files of others or, unless `restart`, a run that did not finish.
  CaseFolder(const std::filesystem::path& path, RunKind kind, const RunSpec& spec, bool restart);
  // Of a run that goes on: locked, with all of its files. Throws Error where it is in use.
  explicit CaseFolder(const std::filesystem::path& path);

  const Folder& folder() const { return folder_; }

 private:
  Folder folder_;
  FolderLock lock_;
};

const std::atomic<bool>& never_stops();  // a flag that is never set
// Calls options.begins; returns its flag, or one that is never set.
const std::atomic<bool>* begin_run(const RunCaseOptions& options);
// Of the text of case.toml, and of the files that the case names.
FileHashes hashes_of(const RunSpec& spec, const std::string& case_text);
std::map<std::string, std::string> all_versions(const RunCaseOptions& options);

}  // namespace seiche
