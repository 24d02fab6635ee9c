// What came of a run.
#pragma once

#include <seiche/core/control/archive.hpp>
#include <seiche/core/linear_part.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/core/replaced_steps.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace seiche {

// Whether the energy law is promised, and why (not).
struct LawPromise {
  bool promised = false;
  std::string reason;  // the hypothesis that carries it, or the one that fails
  // Of H along exact solutions, whatever a method makes of it.
  bool never_grows = false, never_changes = false;

  void withdraw(std::string why) {  // by a method that does not keep it; the solutions stay what they are
    promised = false;
    reason = std::move(why);
  }
};

enum class LawVerdict {
  holds,
  violated,
  not_promised,
  not_tested,  // promised, and no two records to compare
};

struct EnergySummary {
  double initial = 0.0;
  double final = 0.0;
  double max_increase = 0.0;  // max over the recorded steps of after − before; negative if it always fell
};

// H from where it started, or behind an event, to where that is furthest from what the equation does.
struct EnergyDrift {
  double from = 0.0;
  double to = 0.0;
  double t = 0.0;          // of `to`
  bool is_damped = false;  // the equation lets H fall; else it keeps H
  // Of a modified energy, `from` and `to` being it and H at the same time.
  bool is_parting = false;
  std::string text() const;  // "H itself rose from 1 to 300 at t = 2"
  void archive(Archive& a) { a(from, to, t, is_damped, is_parting); }
};

// What a message is made of: "; more" behind it, unless it says that already, or `more` is "".
void add_to(std::string& message, const std::string& more);

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
  std::optional<EnergyDrift> drift;  // by more than a tenth, where no violated law says it already
  Potential::Counts potential_counts;
  std::optional<SolverShare> solver;
  std::int64_t scalar_iterations = 0;
  std::int64_t fallbacks = 0;  // times a solver left its first choice; most of them cost no accuracy
  ReplacedSteps replaced;
  // Steps in which h does not resolve what the damping acts on and the energy interval was widened for it (by more than
  // a thousandth of the dissipation), and steps that were taken in parts.
  std::int64_t widened = 0, halved = 0;
  std::int64_t unresolved = 0;
  std::int64_t rejected = 0;        // steps tried and taken back, with variable steps
  std::vector<double> events = {};  // times at which events were met
  double wall_seconds = 0.0;
  bool step_failed = false;  // what ended the run: a step, or a state that is not finite, and no file

  // Steps that were replaced: how many, why, what that means and what helps; "" if no step was.
  std::string remark_on_replaced() const;
  // More than one step in ten was replaced, or one by next to nothing: what has come out is no solution of the
  // equation.
  bool lacks_solution() const { return replaced.lost_state || replaced.count > steps / 10; }
  void judge_replaced();                  // says that remark; a run that lacks a solution has failed
  std::string remark_on_widened() const;  // where the energy interval was widened beyond its doubt; or ""
  std::string remark_on_halved() const;   // what it does not resolve of the rest; or ""
  std::string remark_on_drift() const;    // what H did that no solution does, and what helps; "" where it did not
  // How far the auxiliary variable has taken H from the modified energy, where that is more than a thousandth and less
  // than a drift; else "".
  std::string remark_on_parting() const;
  std::vector<std::string> remarks() const;  // on steps that were replaced or halved, and on a drift
  void say(const std::string& more) { add_to(message, more); }
  // All of the above, and what is to be known of the law. Where a step failed, what became of the energies up to there
  // is the same news again. `lost_digits`: of a modified energy.
  void say_remarks(const std::string& lost_digits);
  std::string brief() const;  // one line
  std::string full() const;   // a paragraph for a terminal
  std::string work() const;   // how often V was evaluated, and what solvers did: a line below that
};

std::string counted_steps(std::int64_t count);  // "1 step", "2 steps"
// How runs and members of ensembles end: "reached t = 1 in 2 steps", "stopped at t = 1 (step 2) of 3"
std::string reached(double t, std::int64_t steps);
std::string stopped(double t, std::int64_t n, double t_end);
std::string to_string(RunReport::Status status);  // "success", "failed", "interrupted"
std::string to_string(LawVerdict verdict);        // "holds", "violated", "not promised", "not tested"

}  // namespace seiche
