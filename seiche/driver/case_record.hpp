// What the record of a run and that of an ensemble have in common: the folder with its case, what was said before the
// first step, and what the run went on from.
#pragma once

#include <seiche/driver/going_on.hpp>

#include <atomic>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace seiche {

class CaseRecord {
 public:
  // From the start: makes the folder that the case names. `notes`: what there is to say before the first step.
  CaseRecord(const RunSpec& spec, RunKind kind, const std::string& headline, std::vector<std::string> notes,
             const RunCaseOptions& options);
  // From a checkpoint, which outlives the record: nothing on the disk is changed before the next two.
  CaseRecord(GoingOn& from, const std::string& headline, const RunCaseOptions& options);

  const Folder& folder() const { return folder_->folder(); }
  const std::atomic<bool>& stop() const { return *stop_; }
  const std::vector<std::string>& notes() const { return notes_; }
  const FileHashes& hashes() const { return hashes_; }
  const std::map<std::string, std::string>& versions() const { return versions_; }
  const SavedRun* saved() const { return from_ != nullptr ? &from_->from.run : nullptr; }  // null: from the start
  Archive* rest() const { return from_ != nullptr ? &from_->from.rest : nullptr; }

  // These make the folder that of a run that goes on, and do nothing for one from the start. Before its files are
  // opened: a new end is put into its checkpoints.
  void put_new_end() const;
  // When they are: what tells of the end of before goes, and case.toml is that of the checkpoint; another one is kept
  // aside.
  void take_over();

  // What a checkpoint holds beside what is known to the time loop and to the files of the run.
  SavedRun now(std::int64_t n, double t) const;
  std::vector<ResumedWith> resumed_with() const;

 private:
  // Of a resume that was killed when it had put a new end into its checkpoints, and not yet here.
  bool is_of_before_new_end(const std::string& case_text) const;
  bool goes_on() const { return from_ != nullptr && !options_.stops_at_once; }

  const RunCaseOptions& options_;
  RunKind kind_;
  std::map<std::string, std::string> versions_;
  std::vector<std::string> notes_;
  std::string case_text_;  // of case.toml
  FileHashes hashes_;
  const std::atomic<bool>* stop_ = nullptr;
  GoingOn* from_ = nullptr;
  std::optional<CaseFolder> own_folder_;  // of a run from the start
  CaseFolder* folder_;
};

}  // namespace seiche
