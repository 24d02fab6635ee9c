#include <seiche/core/base/error.hpp>
#include <seiche/core/base/vector.hpp>
#include <seiche/loop/recording.hpp>
#include <seiche/loop/settle_report.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

namespace seiche {
namespace {

// A loop may be given a system without a linear part.
std::optional<SolverShare> solver_share_of(const System& system) {
  return system.linear ? system.linear->solver_share() : std::nullopt;
}

bool is_finite(const EnergyReading& reading) { return std::isfinite(reading.H) && std::isfinite(reading.modified); }

}  // namespace

Index JointStates::size_of_all(const Vector& mine) const {
  return static_cast<Index>(space_.sum(static_cast<double>(mine.size())));
}

void JointStates::join(const Vector& mine, FunctionRef<void(std::span<const double> piece)> write) const {
  space_.join(space_.slots(), {mine.data(), static_cast<std::size_t>(mine.size())}, write);
}

void JointStates::part(Index all, FunctionRef<void(Index from, std::span<double> to)> read, Vector& mine) const {
  const Space::Field field = space_.slots();
  const Index fields = all % field.of == 0 ? all / field.of : 0;  // none: of another grid
  mine.resize(fields * field.size);
  for (Index f = 0; f < fields; ++f)
    read(f * field.of + field.first, {mine.data() + f * field.size, static_cast<std::size_t>(field.size)});
}

Recording::Recording(const System& system, const Stepper& stepper, State& state, const LawPromise& law,
                     const std::function<std::string()>& explanation, std::span<Observer* const> observers)
    : system_(system),
      stepper_(stepper),
      state_(state),
      joint_(*system.space),
      observers_(observers),
      explanation_(explanation),
      book_(law, stepper.has_modified_energy()),
      first_n_(state.n),
      counts_before_(system.potential->counts()),
      solver_before_(solver_share_of(system)),
      begin_(std::chrono::steady_clock::now()) {
  keep_good();
}

void Recording::count(const StepReport& step) {
  report_.scalar_iterations += step.scalar_iterations;
  report_.fallbacks += step.fallbacks;
  report_.unresolved += step.unresolved;
}

void Recording::enter(const StepReport& step) {
  ledger_ += step.ledger;
  report_.replaced += step.replaced;
  report_.widened += step.widened;
  report_.halved += step.halved;
}

bool Recording::anyone_due() const {
  bool due = false;
  for (const Observer* observer : observers_) due |= observer->is_due(state_, false);
  if (!due)
    for (Observer* observer : observers_) observer->pass(state_);
  return due;
}

bool Recording::record(bool last) {
  EnergyReading reading = stepper_.energy(state_);
  reading.ledger = ledger_;
  if (!is_finite(reading) || !system_.space->is_finite(state_.z)) {
    fail_not_finite(is_finite(reading) ? "state" : "energy");
    return false;
  }
  book_.add(reading, state_.t, state_.n);
  show(state_, reading, [&](Observer& observer) {
    const bool due = observer.is_due(state_, last);
    if (!due) observer.pass(state_);
    return due;
  });
  keep_good();
  return true;
}

void Recording::keep_good() {
  good_.state.start_from(state_);
  good_.ledger = ledger_;
  good_.replaced = report_.replaced;
  good_.widened = report_.widened;
  good_.halved = report_.halved;
  good_.unresolved = report_.unresolved;
}

void Recording::go_back() {
  state_.start_from(good_.state);
  ledger_ = good_.ledger;
}

bool Recording::check_finite() {
  if (system_.space->is_finite(state_.z)) return true;
  fail_not_finite("state");
  return false;
}

double Recording::next_time() const {
  double next = std::numeric_limits<double>::infinity();
  for (const Observer* observer : observers_) next = std::min(next, observer->next_time());
  return next;
}

void Recording::show(const State& between) {
  const EnergyReading reading = stepper_.energy(between);
  show(between, reading, [&](const Observer& observer) { return observer.next_time() <= between.t; });
}

void Recording::show(const State& state, const EnergyReading& reading, FunctionRef<bool(Observer&)> is_meant) {
  std::exception_ptr failure;
  for (Observer* observer : observers_) {
    if (!is_meant(*observer)) continue;
    if (failure) {
      observer->skip(state);
      continue;
    }
    try {
      observer->observe(state, reading);
    } catch (const Error&) {
      failure = std::current_exception();
    }
  }
  const bool fails = system_.space->any(failure != nullptr);
  if (failure) std::rethrow_exception(failure);
  if (fails) throw Error("another process could not record the state");
}

// The last good state of a run that ended early, for those who have not seen it.
void Recording::record_rest() {
  EnergyReading reading = stepper_.energy(state_);
  reading.ledger = ledger_;
  if (!is_finite(reading) || !system_.space->is_finite(state_.z)) {
    go_back();
    return;
  }
  if (!book_.has(state_.n)) book_.add(reading, state_.t, state_.n);
  show(state_, reading,
       [&](const Observer& observer) { return !observer.is_due(state_, false) && observer.is_due(state_, true); });
}

void Recording::fail(std::string message) {
  report_.status = RunReport::Status::failed;
  report_.message = std::move(message);
}

void Recording::fail_step(const std::string& reason) {
  fail(fmt::format("step {} failed after t = {:.9g}: {}", state_.n + 1, state_.t, reason));
  report_.step_failed = true;
  explain();
}

void Recording::fail_not_finite(const char* what) {
  fail(state_.n == good_.state.n
           ? fmt::format("the {} is not finite at the start, t = {:.9g}", what, state_.t)
           : fmt::format("the {} is no longer finite at t = {:.9g} (step {}); the data end at the last good record, "
                         "t = {:.9g} (step {})",
                         what, state_.t, state_.n, good_.state.t, good_.state.n));
  report_.step_failed = true;
  // By what lies ahead of the last good record, or, where steps lie between, by where the state is.
  const bool explained = state_.n > good_.state.n + 1 && explain();
  go_back();
  if (!explained) explain();
}

bool Recording::explain() {
  const std::string why = explanation_ ? explanation_() : "";
  report_.say(why);
  return !why.empty();
}

void Recording::interrupt(double t_end) {
  report_.status = RunReport::Status::interrupted;
  report_.message = stopped(state_.t, state_.n, t_end);
}

void Recording::interrupt_inside_step(double t_end) {
  go_back();
  report_.replaced = good_.replaced;
  report_.widened = good_.widened;
  report_.halved = good_.halved;
  report_.unresolved = good_.unresolved;
  interrupt(t_end);
}

void Recording::abandon(const std::string& reason) {
  fail(fmt::format("the run stopped after t = {:.9g} (step {}): {}", state_.t, state_.n, reason));
  go_back();
  abandoned_ = true;
}

RunReport Recording::finish(const std::function<std::string()>& objection, const std::string& remark) {
  if (report_.status != RunReport::Status::success && !abandoned_) {
    try {
      record_rest();
    } catch (const Error& error) {
      abandon(error.what());
    }
  }
  report_.steps = steps();
  report_.t = state_.t;
  book_.write_to(report_);
  settle_report(
      report_, system_, [&] { return system_.space->physical(state_.z); }, [&] { return met_by(objection); });
  report_.potential_counts = counts();
  report_.solver = solver_share();
  complete_message(remark);
  report_.wall_seconds = seconds();
  finish_observers();
  return report_;
}

Potential::Counts Recording::counts() const {
  const Potential::Counts now = system_.potential->counts();
  return {counts_earlier_.gradients + now.gradients - counts_before_.gradients,
          counts_earlier_.values + now.values - counts_before_.values};
}

std::optional<SolverShare> Recording::solver_share() const {
  std::optional<SolverShare> share = solver_share_of(system_);
  if (!share) return share;
  share->iterations += solver_earlier_.iterations - (solver_before_ ? solver_before_->iterations : 0);
  share->restored = std::max(share->restored, solver_earlier_.restored);
  return share->iterations > 0 ? share : std::nullopt;  // a method may ask for no linear system
}

void Recording::count_from_here() {
  counts_before_ = system_.potential->counts();
  solver_before_ = solver_share_of(system_);
}

double Recording::seconds() const {
  return seconds_earlier_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

bool Recording::pauses(bool stops, Checkpoints* checkpoints, FunctionRef<void(Archive&)> run) const {
  if (checkpoints == nullptr) return stops;
  const Checkpoints::Wish wish = stops ? Checkpoints::Wish::save_and_stop : checkpoints->wish(state_.n);
  if (wish != Checkpoints::Wish::none && system_.space->is_finite(state_.z)) checkpoints->save(state_.n, state_.t, run);
  return wish == Checkpoints::Wish::save_and_stop;
}

std::string Recording::met_by(const std::function<std::string()>& objection) const {
  const std::string reason = objection ? objection() : "";
  return reason.empty() ? earlier_objection_ : reason;
}

void Recording::archive(Archive& a, const std::function<std::string()>& objection) {
  Potential::Counts counts_so_far = counts();
  SolverShare solver_so_far = solver_share().value_or(SolverShare());
  double seconds_so_far = seconds();
  std::string met = met_by(objection);
  a.join_vectors(joint_);
  a(state_, first_n_, book_, ledger_);
  a(report_.scalar_iterations, report_.fallbacks, report_.unresolved, report_.replaced, report_.widened, report_.halved,
    report_.rejected, report_.events, met, seconds_so_far);
  a.numbers(counts_so_far);
  a(solver_so_far.iterations, solver_so_far.restored);
  if (!a.reads()) return;
  keep_good();
  earlier_objection_ = met;
  counts_earlier_ = counts_so_far;
  solver_earlier_ = solver_so_far;
  seconds_earlier_ = seconds_so_far;
  count_from_here();
  begin_ = std::chrono::steady_clock::now();
}

void Recording::complete_message(const std::string& remark) {
  if (report_.status == RunReport::Status::success) report_.message = reached(state_.t, report_.steps) + remark;
  constexpr double lost = 1e6;  // times the energy at the start: of H̃ − H no more than some ten digits are left
  const bool has_lost =
      report_.has_modified_energy && state_.energy_scale > 0 && state_.shift > lost * state_.energy_scale;
  report_.say_remarks(
      has_lost ? fmt::format("C was raised to {:.3g} ({:.1g} × the initial energy), and the modified energy has lost "
                             "digits to round-off: reduce h, or use seilm or egc4",
                             state_.shift, state_.shift / state_.energy_scale)
               : "");
}

// Each gets its chance to leave whole files, also where another one could not.
void Recording::finish_observers() {
  for (Observer* observer : observers_) {
    try {
      observer->finish(report_);
    } catch (const Error& error) {
      if (report_.status == RunReport::Status::success) report_.message = error.what();
      report_.status = RunReport::Status::failed;
      report_.say(error.what());  // several files, one reason
    }
  }
}

}  // namespace seiche
