// What came of a run.
#pragma once

#include <seiche/core/potential.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace seiche {

// Is the energy law promised, and why (not)?
struct LawPromise {
  bool promised = false;
  std::string reason;  // the hypothesis that carries it, or the one that fails
};

enum class LawVerdict { holds, violated, not_promised };

struct EnergySummary {
  double initial = 0.0;
  double final = 0.0;
  double max_increase = 0.0;  // max over the recorded steps of after − before; negative if it always fell
};

struct RunReport {
  enum class Status { success, failed, interrupted };
  Status status = Status::success;
  std::string message;  // one sentence: how the run ended, and what the user should know
  std::int64_t steps = 0;
  double t = 0.0;
  EnergySummary energy;
  bool has_modified_energy = false;
  EnergySummary modified;
  LawVerdict law = LawVerdict::not_promised;
  std::string law_reason;
  Potential::Counts potential_counts;
  std::int64_t scalar_iterations = 0;
  std::int64_t fallbacks = 0;
  std::int64_t unresolved = 0;
  std::int64_t rejected = 0;        // steps tried and taken back, with variable steps
  std::vector<double> events = {};  // times at which events were met
  double wall_seconds = 0.0;

  std::string brief() const;  // one line
  std::string full() const;   // a paragraph for a terminal
};

std::string to_string(RunReport::Status status);  // "success", "failed", "interrupted"
std::string to_string(LawVerdict verdict);        // "holds", "violated", "not promised"

}  // namespace seiche
