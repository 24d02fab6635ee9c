// Ensembles: many initial states or parameters of one small problem, stepped together.
#pragma once

#include <seiche/core/run_report.hpp>
#include <seiche/ensemble/member_block.hpp>
#include <seiche/ensemble/statistics.hpp>
#include <seiche/loop/checkpoints.hpp>

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace seiche {

// Over the members that run at t, by every recorded step.
struct EnsembleRecord {
  double t = 0.0;
  Index running = 0;
  Statistics H{}, modified{};
};

struct EnsembleOptions {
  SimulationOptions simulation = {};
  double h = 0.0;
  double t_start = 0.0, t_end = 0.0;
  std::int64_t energy_every = 1;                              // steps between records
  int threads = 1;                                            // results do not depend on it, to the last bit
  std::function<LawPromise(const Simulation&)> promise = {};  // none: no law is promised
  std::function<std::string(const Problem&)> objection = {};  // why a promise is withdrawn after all, or ""
  // In the order of time, on the calling thread, while any member runs. What it throws as Error ends the run.
  std::function<void(const EnsembleRecord&)> on_record = {};
  std::function<void()> on_pause =
      {};  // on the calling thread, about every tenth of a second, however far records lie apart
  const std::atomic<bool>* stop = nullptr;  // the run ends soon after it is set, and records where
  // To the same bits, whatever the number of threads was before. An Error of who keeps checkpoints ends the run.
  Resumption resumption = {};
};

struct MemberResult {
  RunReport report;
  Vector final;  // physical values of the last good state; empty if the member could not start
};

struct EnsembleResult {
  std::vector<MemberResult> members;
  bool side_by_side = false;  // members were stepped side by side
  std::string failure;        // what on_record threw, or who keeps checkpoints, or ""
  double wall_seconds = 0.0;
};

// Every member runs as it would alone, from t_start to t_end, by fixed steps of which the last is shortened; one that
// fails stops with its message, and the others go on. Throws Error where no member can start, with the reason of the
// first, where members differ in their number of unknowns, and where it is stopped before they are set up.
EnsembleResult run_ensemble(std::span<const EnsembleMember> members, const EnsembleOptions& options);

}  // namespace seiche
