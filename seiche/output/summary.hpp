// summary.json: what was run and what came of it, for programs. Also what `seiche run --json` prints.
#pragma once

#include <seiche/core/control/archive.hpp>
#include <seiche/core/run_report.hpp>
#include <seiche/output/file/sha256.hpp>

#include <ctime>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace seiche {

// A run that went on from a checkpoint, and with what.
struct ResumedWith {
  double t = 0.0;                               // of the checkpoint
  std::map<std::string, std::string> versions;  // what computed from there on
  std::optional<double> end = std::nullopt;     // another time.end than that of the checkpoint
  void archive(Archive& a) { a(t, versions, end); }
};

struct RunIdentity {
  std::string problem;
  std::string method;
  std::string backend;
  double h = 0.0;  // of variable steps: NaN
  std::optional<double> tolerance = std::nullopt;
  std::string certificate = {};  // a JSON document: which hypotheses of the energy law are met, or "" for none
  std::map<std::string, std::string> versions = {};
  std::vector<ResumedWith> resumed_with = {};  // in the order of the resumes
  int threads = 0;                             // 0: not told
  int processes = 1;
  FileHashes hashes = {};  // of case.toml, and of the files that it names
  std::time_t finished = std::time(nullptr);
};

// {"resumed_at": […], "resumed_with": […]}, or {} of a run that never was.
std::string resumed_json(const std::vector<ResumedWith>& all);
// A number that is not finite becomes null, since JSON has no NaN; so does `modified` for a method that has none.
std::string summary_json(const RunIdentity& run, const RunReport& report);

}  // namespace seiche
