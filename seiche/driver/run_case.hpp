// One case, from its description to the folder of files that it leaves: what `seiche run` and Python's `seiche.run` do.
#pragma once

#include <seiche/config/case/run_spec.hpp>
#include <seiche/core/grid/ranks.hpp>
#include <seiche/core/observer.hpp>
#include <seiche/simulation/certificate.hpp>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace seiche {

// What the caller lends a run. All of it may be left out.
struct RunCaseOptions {
  int threads = 1;                    // over a large grid, or the members of an ensemble; results do not depend on it
  bool restart = false;               // begin anew where the folder holds a run that did not finish, which is removed
  double max_hours = 0;               // after which a run is saved and ends as if it had been interrupted; 0: never
  bool stops_at_once = false;         // before its first step, all files written: makes readable what a kill has left
  std::atomic<bool>* save = nullptr;  // where it is set, a run writes a checkpoint, clears it, and goes on
  std::function<void(double t_end)> ends_at = {};  // of a run that goes on, before `begins`: where it will end
  // Before the first step, when nothing is refused any more. Returns a flag that ends the run after the step in which
  // it is set, or null.
  std::function<const std::atomic<bool>*()> begins = {};
  // When the folder is there: what is about to be solved, and what there is to say.
  std::function<void(const std::string& headline, const std::vector<std::string>& notes)> introduce = {};
  // When the time loop has ended and the files are written that cannot be made later. Returns a flag that asks to leave
  // out what can be had later, or null.
  std::function<const std::atomic<bool>*()> ends = {};
  std::function<void(const std::string& note)> warn = {};  // what has gone wrong with files that can be had later
  // Of a single run, behind those that write its files. Of an ensemble they are told by `pass` where its records lie.
  std::vector<Observer*> observers = {};
  std::map<std::string, std::string> versions = {};  // of the caller, for summary.json
  // The processes that run the case together, each of which calls for it; they outlive the call. Null: this one alone.
  const Ranks* ranks = nullptr;
};

struct GoingOn;

struct CaseResult {
  RunReport report;              // as it is in the files
  std::string message;           // that of the report, with the notes
  Certificate certificate;       // as it is behind the run
  std::string feeds;             // where a rate of linear damping is negative: which, and when
  std::string summary;           // summary.json
  std::uint64_t xdmf_every = 1;  // solution.xdmf shows every n-th time of solution.h5
};

// Leaves case.toml, energy.csv, solution.h5 with solution.xdmf, final.txt, summary.json and report.html in `folder`,
// which replaces spec.output_directory. Throws Error for set-up mistakes, and where the folder is in use or not its
// own; a computation that fails is a status of the report, with what was computed before on disk. Of several processes
// the first one calls it and writes the files, while the others call follow_case.
CaseResult run_case(RunSpec spec, const std::filesystem::path& folder, const RunCaseOptions& options = {});

// Leaves the same files with the same numbers as a run that was never stopped.
CaseResult resume_case(GoingOn from, const RunCaseOptions& options = {});

}  // namespace seiche
