// What every time loop does beside stepping: judge energies, show states to observers, keep the last good one, and
// report.
#pragma once

#include <seiche/core/control/archive.hpp>
#include <seiche/core/observer.hpp>
#include <seiche/core/system.hpp>
#include <seiche/loop/checkpoints.hpp>
#include <seiche/loop/energy_book.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace seiche {

// Vectors in the coordinates of the state.
class JointStates final : public JointVectors {
 public:
  explicit JointStates(const Space& space) : space_(space) {}
  Index size_of_all(const Vector& mine) const override;
  void join(const Vector& mine, FunctionRef<void(std::span<const double> piece)> write) const override;
  void part(Index all, FunctionRef<void(Index from, std::span<double> to)> read, Vector& mine) const override;

 private:
  const Space& space_;
};

class Recording {
 public:
  // All outlive the recording. `explanation`: why no step goes on from the state, or ""; null if no one knows. It is
  // asked where a step has failed or led to no finite energy.
  Recording(const System& system, const Stepper& stepper, State& state, const LawPromise& law,
            const std::function<std::string()>& explanation, std::span<Observer* const> observers);

  RunReport& report() { return report_; }
  bool has_failed() const { return report_.status != RunReport::Status::success; }
  std::int64_t steps() const { return state_.n - first_n_; }

  void count(const StepReport& step);  // its work, whatever came of it
  void enter(const StepReport& step);  // of a step that stands: its ledger, and whether it was replaced
  bool anyone_due() const;
  // Energy of the state, judged and shown to the observers that are due; false if it is not finite: the run has failed.
  bool record(bool last);
  bool check_finite();  // the same look at z alone

  void reopen() { book_.reopen(); }  // after an event: what it did to the energy is not the method's

  // Observers that asked for a time up to `until`: the earliest such time, or infinity.
  double next_time() const;
  void show(const State& between);  // to those who asked for its time

  void fail(std::string message);
  void fail_step(const std::string& reason);
  void interrupt(double t_end);
  void interrupt_inside_step(double t_end);  // which has left the state in between: back to the last record

  // Everything that is left to do when the loop has ended, by success or not. `objection`: why the promise is withdrawn
  // after all, or null; `remark`: what a successful run says about its steps.
  RunReport finish(const std::function<std::string()>& objection, const std::string& remark);
  void abandon(const std::string& reason);  // an Error of a propagator, a full disk

  // True if the run is to stop between two steps. `run` writes it to `checkpoints` (null: not kept) before that, and
  // whenever one is wanted; never where the state is not finite.
  bool pauses(bool stops, Checkpoints* checkpoints, FunctionRef<void(Archive&)> run) const;
  // The state, and what a run has counted and judged so far. `objection` as for `finish`: what has been met stays met
  // in a run that goes on from here.
  void archive(Archive& a, const std::function<std::string()>& objection);
  // What was evaluated up to now to go on from a checkpoint has been counted before it.
  void count_from_here();

 private:
  void fail_not_finite(const char* what);
  bool explain();    // adds to the message why no step goes on from the state; false: no one knows
  void keep_good();  // the state and what has been entered up to it
  void go_back();    // to the state of the last record, and the ledger up to there
  void record_rest();
  // Each of these observers sees the state, up to one that fails; then all processes throw Error.
  void show(const State& state, const EnergyReading& reading, FunctionRef<bool(Observer&)> is_meant);
  std::string met_by(const std::function<std::string()>& objection) const;  // or before a resume
  void complete_message(const std::string& remark);
  void finish_observers();
  Potential::Counts counts() const;
  std::optional<SolverShare> solver_share() const;  // likewise
  double seconds() const;

  const System& system_;
  const Stepper& stepper_;
  State& state_;
  JointStates joint_;
  std::span<Observer* const> observers_;
  const std::function<std::string()>& explanation_;
  EnergyBook book_;
  StepLedger ledger_;  // of all steps
  RunReport report_;
  struct Good {
    State state;  // without what is known of earlier steps
    StepLedger ledger = {};
    ReplacedSteps replaced = {};
    std::int64_t widened = 0, halved = 0, unresolved = 0;
  } good_;  // as last recorded
  bool abandoned_ = false;
  std::int64_t first_n_;
  std::string earlier_objection_;     // of the run that this one goes on from
  Potential::Counts counts_earlier_;  // likewise
  double seconds_earlier_ = 0;
  SolverShare solver_earlier_;
  Potential::Counts counts_before_;
  std::optional<SolverShare> solver_before_;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace seiche
