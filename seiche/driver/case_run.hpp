// One run of a case in its folder, from its first file to its last.
#pragma once

#include <seiche/config/case/run_spec.hpp>
#include <seiche/driver/case_folder.hpp>
#include <seiche/driver/checkpoint_keeper.hpp>
#include <seiche/driver/run_case.hpp>
#include <seiche/driver/saved_run.hpp>
#include <seiche/output/energy_trace.hpp>
#include <seiche/output/solution_file.hpp>
#include <seiche/simulation/prepared_run.hpp>

#include <atomic>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace seiche {

// Where a run goes on, and from what.
struct GoingOn {
  CaseFolder& folder;
  Checkpoint from;
  std::optional<double> new_end = {};  // of the spec, where it is not that of the checkpoint
};

class CaseRun {
 public:
  // From a checkpoint, or in the folder that the case names from its start. One that goes on has changed nothing on the
  // disk before `result`, and then nothing that is lost where its files cannot be made.
  CaseRun(RunSpec spec, const Problem& problem, const RunCaseOptions& options, GoingOn* from = nullptr);

  CaseResult result();

  static constexpr const char* wisdom_name = "fftw_wisdom";

 private:
  void begin(const Problem& problem);
  void go_on();
  void make_files();
  void take_over();  // the folder of the run that this one goes on from, when the files are made
  void warn(const std::string& note) const;
  void describe(SavedRun& saved);

  // The report, with a message that says whether a time limit interrupted the run, and how it can be continued.
  RunReport with_way_on(RunReport report) const;
  RunReport with_notes(RunReport report) const;
  std::string summary(const RunReport& report);
  std::vector<ResumedWith> resumed_with() const;

  RunSpec spec_;
  const RunCaseOptions& options_;
  std::map<std::string, std::string> versions_;
  std::string problem_;
  PreparedRun run_;
  bool is_modified_;
  std::vector<std::string> notes_;
  std::string case_text_;  // of case.toml
  FileHashes hashes_;
  std::optional<std::time_t> finished_;
  const std::atomic<bool>* stop_ = nullptr;
  GoingOn* from_;  // null: from the start
  CaseFolder* folder_;
  std::optional<CaseFolder> own_folder_;  // of a run from the start
  std::optional<EnergyTrace> trace_;
  std::optional<SolutionFile> solution_;
  std::optional<CheckpointKeeper> keeper_;
};

}  // namespace seiche
