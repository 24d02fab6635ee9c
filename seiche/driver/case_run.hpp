// One run of a case in its folder, from its first file to its last.
#pragma once

#include <seiche/config/case/run_spec.hpp>
#include <seiche/driver/case_record.hpp>
#include <seiche/driver/checkpoint_keeper.hpp>
#include <seiche/driver/joint_checkpoints.hpp>
#include <seiche/driver/run_case.hpp>
#include <seiche/output/energy_trace.hpp>
#include <seiche/record/solution_file.hpp>
#include <seiche/simulation/prepared_run.hpp>

#include <ctime>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace seiche {

// What all processes of a run do alike.
Problem problem_here(const RunSpec& spec, const RunCaseOptions& options);  // what this one holds of it
RunPlan run_plan(const RunSpec& spec, const RunCaseOptions& options);
SnapshotTimes snapshot_times(const RunSpec& spec);
// The physical values of the state: of several processes those of all, which the first one gets.
void join_values(const Simulation& simulation, FunctionRef<void(std::span<const double> piece)> take);

class CaseRun {
 public:
  // From a checkpoint, or in the folder that the case names from its start. One that goes on has changed nothing on the
  // disk before `result`, and then nothing that is lost where its files cannot be made.
  CaseRun(RunSpec spec, const Problem& problem, const RunCaseOptions& options, GoingOn* from = nullptr);

  CaseResult result();

  static constexpr const char* wisdom_name = "fftw_wisdom";

 private:
  static std::unique_ptr<CaseRecord> make_record(RunSpec& spec, const Problem& problem, PreparedRun& run,
                                                 const RunCaseOptions& options, GoingOn* from);
  void make_files();
  void warn(const std::string& note) const;
  SavedRun now(std::int64_t n, double t);

  // No resume comes farther: the run reached its end, or a step failed, and all files are whole.
  bool is_over(const RunReport& report) const;
  // The report, with a message that says whether a time limit interrupted the run, and how it can be continued.
  RunReport with_way_on(RunReport report) const;
  RunReport with_notes(RunReport report) const;
  std::string summary(const RunReport& report);

  RunSpec spec_;
  const RunCaseOptions& options_;
  std::string problem_;
  PreparedRun run_;
  std::unique_ptr<CaseRecord> record_;
  std::optional<std::time_t> finished_;
  std::string said_by_loop_;  // the message, before files were finished
  std::optional<EnergyTrace> trace_;
  std::optional<SolutionFile> solution_;
  std::optional<CheckpointKeeper> keeper_;
  std::optional<JointCheckpoints> joint_;  // where there are several processes
};

}  // namespace seiche
