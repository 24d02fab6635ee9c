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

class CaseRun {
 public:
  // In `folder`, from a checkpoint; or in the folder that the case names, from its start.
  CaseRun(RunSpec spec, const Problem& problem, const RunCaseOptions& options, CaseFolder* folder = nullptr,
          Checkpoint* from = nullptr);

  CaseResult result();

  static constexpr const char* wisdom_name = "fftw_wisdom";

 private:
  void begin(const Problem& problem);
  void go_on();
  void make_files();
  void describe(SavedRun& saved);

  // The report, with a message that says whether a time limit interrupted the run, and how it can be continued.
  RunReport with_way_on(RunReport report) const;
  RunReport with_notes(RunReport report) const;
  std::string summary(const RunReport& report);
  std::vector<double> resumed_at() const;

  RunSpec spec_;
  const RunCaseOptions& options_;
  std::map<std::string, std::string> versions_;
  std::string problem_;
  PreparedRun run_;
  bool is_modified_;
  std::vector<std::string> notes_;
  std::string case_text_;  // of case.toml
  FileHashes hashes_;
  const std::atomic<bool>* stop_ = nullptr;
  Checkpoint* from_;  // null: from the start
  CaseFolder* folder_;
  std::optional<CaseFolder> own_folder_;  // of a run from the start
  std::optional<EnergyTrace> trace_;
  std::optional<SolutionFile> solution_;
  std::optional<CheckpointKeeper> keeper_;
};

}  // namespace seiche
