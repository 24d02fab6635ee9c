#include <seiche/core/error.hpp>
#include <seiche/run/energy_book.hpp>
#include <seiche/run/integrate.hpp>
#include <seiche/run/time_grid.hpp>

#include <chrono>
#include <cmath>
#include <string>

namespace seiche {
namespace {

bool is_finite(const EnergyReading& reading) { return std::isfinite(reading.H) && std::isfinite(reading.modified); }

// Steps between two looks for NaN where nothing is recorded: rare enough to cost nothing.
constexpr std::int64_t finite_check_every = 64;

class Run {
 public:
  Run(const System& system, Stepper& stepper, State& state, const IntegrateOptions& options,
      std::span<Observer* const> observers)
      : system_(system),
        stepper_(stepper),
        state_(state),
        options_(options),
        observers_(observers),
        grid_(state.t, options.h, options.t_end),
        book_(options.law, stepper.has_modified_energy()),
        good_(state) {}

  RunReport run() {
    const auto begin = std::chrono::steady_clock::now();
    const Potential::Counts before = system_.potential->counts();
    try {
      loop();
      if (report_.status != RunReport::Status::success) record_rest();
    } catch (const Error& error) {  // a propagator that does not exist, a disk that is full
      fail(fmt::format("the run stopped after t = {:.9g} (step {}): {}", state_.t, state_.n, error.what()));
      state_ = good_;
    }
    report_.steps = state_.n - first_n_;
    report_.t = state_.t;
    book_.write_to(report_);
    hear_objection();
    const Potential::Counts after = system_.potential->counts();
    report_.potential_counts = {after.gradients - before.gradients, after.values - before.values};
    complete_message();
    report_.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    finish_observers();
    return report_;
  }

 private:
  void loop() {
    if (!record(grid_.steps == 0)) return;
    for (std::int64_t k = 1; k <= grid_.steps; ++k) {
      if (options_.stop && options_.stop->load(std::memory_order_relaxed)) return interrupt();
      const StepReport step = stepper_.step(state_, grid_.step_size(k));
      report_.scalar_iterations += step.scalar_iterations;
      report_.fallbacks += step.fallbacks;
      report_.unresolved += step.unresolved;
      if (!step.solved()) return fail_step(step.message);
      state_.n = first_n_ + k;
      state_.t = grid_.time(k);
      const bool last = k == grid_.steps;
      if (last || anyone_due()) {
        if (!record(last)) return;
      } else if (k % finite_check_every == 0 && !state_.z.allFinite()) {
        return fail_not_finite("state");
      }
    }
  }

  bool anyone_due() const {
    bool due = false;
    for (const Observer* observer : observers_) due |= observer->is_due(state_, false);
    return due;
  }

  // Energy of the state, judged and shown to whom it is due; false if there is none.
  bool record(bool last) {
    const EnergyReading reading = stepper_.energy(state_);
    if (!is_finite(reading) || !state_.z.allFinite()) {
      fail_not_finite(is_finite(reading) ? "state" : "energy");
      return false;
    }
    book_.add(reading, state_.t, state_.n);
    for (Observer* observer : observers_) {
      if (observer->is_due(state_, last)) observer->observe(state_, reading);
    }
    good_ = state_;
    return true;
  }

  // The last good state of a run that ended early, for those who have not seen it.
  void record_rest() {
    const EnergyReading reading = stepper_.energy(state_);
    if (!is_finite(reading) || !state_.z.allFinite()) {
      state_ = good_;
      return;
    }
    if (!book_.has(state_.n)) book_.add(reading, state_.t, state_.n);
    for (Observer* observer : observers_) {
      if (!observer->is_due(state_, false) && observer->is_due(state_, true)) observer->observe(state_, reading);
    }
  }

  void fail(std::string message) {
    report_.status = RunReport::Status::failed;
    report_.message = std::move(message);
  }

  void fail_step(const std::string& reason) {
    fail(fmt::format("step {} failed after t = {:.9g}: {}", state_.n + 1, state_.t, reason));
  }

  void fail_not_finite(const char* what) {
    fail(state_.n == good_.n
             ? fmt::format("the {} is not finite at the start, t = {:.9g}", what, state_.t)
             : fmt::format("the {} is no longer finite at t = {:.9g} (step {}); the data end at the last good record, "
                           "t = {:.9g} (step {})",
                           what, state_.t, state_.n, good_.t, good_.n));
    state_ = good_;
  }

  void interrupt() {
    report_.status = RunReport::Status::interrupted;
    report_.message = fmt::format("stopped at t = {:.9g} (step {}) of {:.9g}", state_.t, state_.n, grid_.end);
  }

  void hear_objection() {
    if (report_.law == LawVerdict::not_promised || !options_.objection) return;
    const std::string reason = options_.objection();
    if (reason.empty()) return;
    report_.law = LawVerdict::not_promised;
    report_.law_reason = reason;
  }

  void complete_message() {
    if (report_.status == RunReport::Status::success) {
      report_.message = fmt::format("reached t = {:.9g} in {} steps", state_.t, report_.steps);
      if (grid_.last_is_shortened()) {
        report_.message += fmt::format(
            "; h = {:.9g} does not divide the time {:.9g}, so the last step was shortened to "
            "{:.9g}",
            grid_.h, grid_.end - grid_.start, grid_.last_h);
      }
    }
    if (report_.unresolved > 0) {
      report_.message += fmt::format("; {} scalar equations were not resolved", report_.unresolved);
    }
    if (report_.law == LawVerdict::not_promised)
      report_.message += "; no energy law is promised: " + report_.law_reason;
    if (report_.law == LawVerdict::violated)
      report_.message += "; the promised energy law was violated: " + report_.law_reason;
  }

  // Each gets its chance to leave whole files, also where another one could not.
  void finish_observers() {
    for (Observer* observer : observers_) {
      try {
        observer->finish(report_);
      } catch (const Error& error) {
        const bool first = report_.status == RunReport::Status::success;
        report_.status = RunReport::Status::failed;
        report_.message = first ? std::string(error.what()) : report_.message + "; " + error.what();
      }
    }
  }

  const System& system_;
  Stepper& stepper_;
  State& state_;
  const IntegrateOptions& options_;
  std::span<Observer* const> observers_;
  TimeGrid grid_;
  EnergyBook book_;
  State good_;  // as last recorded
  RunReport report_;
  std::int64_t first_n_ = state_.n;
};

}  // namespace

RunReport integrate(const System& system, Stepper& stepper, State& state, const IntegrateOptions& options,
                    std::span<Observer* const> observers) {
  return Run(system, stepper, state, options, observers).run();
}

}  // namespace seiche
