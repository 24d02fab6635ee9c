#include <seiche/core/base/error.hpp>
#include <seiche/core/control/stop_request.hpp>
#include <seiche/loop/adaptive.hpp>
#include <seiche/loop/event_finder.hpp>
#include <seiche/loop/recording.hpp>
#include <seiche/loop/run_pace.hpp>
#include <seiche/loop/step_controller.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seiche {
namespace {

constexpr int forget_after = 8;  // rejections in a row: what a method remembers does not help any more

class AdaptiveLoop {
 public:
  AdaptiveLoop(const System& system, AdaptiveStepper& stepper, State& state, const AdaptiveOptions& options,
               Recording& recording)
      : system_(system),
        stepper_(stepper),
        state_(state),
        options_(options),
        recording_(recording),
        controller_(stepper.order(), options.tolerance),
        events_(options.events),
        checkpoints_(options.resumption.checkpoints),
        pace_(state.t, options.t_end, system.space->size_of_all()),
        time_(state.t),
        size_(system.space->max_norm(system.space->physical(state.z))) {
    if (options.tolerance < 1e-14 * size_)
      throw Error(
          "the tolerance {:.3g} is below what double precision can tell of numbers as large as {:.3g}; write at least {:.3g}",
          options.tolerance, size_, 1e-14 * size_);
    stepper.expect(controller_.allowed());
  }

  void run() {
    if (options_.resumption.from != nullptr)
      archive(*options_.resumption.from);
    else if (!begin())
      return;
    while (state_.t < options_.t_end) {
      if (pauses()) return recording_.interrupt(options_.t_end);
      if (!advance()) return;
      const std::string objection = pace_.objection(state_.t, h_, [&] { return system_.space->norm(state_.z); });
      if (objection.empty()) continue;
      if (unproven_) state_ = backup_;
      return recording_.fail_step(objection);
    }
  }

  std::string remark() const {
    if (largest_ == 0) return "";
    std::string text =
        fmt::format(" of {:.3g} to {:.3g}, {} rejected", smallest_, largest_, recording_.report().rejected);
    if (size_ > 0 && options_.tolerance > size_)
      text += fmt::format(
          "; the tolerance, {:.3g}, is more than the largest number of the initial state, {:.3g}: it is absolute, "
          "in the units of the fields",
          options_.tolerance, size_);
    return text;
  }

 private:
  bool begin() {
    if (!recording_.record(state_.t >= options_.t_end)) return false;
    const EventFinder::Found at_start = events_.begin(system_, state_);
    if (!at_start.empty()) return happen(at_start);
    start();
    return true;
  }

  // True if the run is to stop here. It is saved before that, and at every request; but not behind a first step whose
  // error is not known yet.
  bool pauses() {
    const bool stops = options_.stop && options_.stop->load(std::memory_order_relaxed);
    if (unproven_) {
      if (!stops) return false;
      take_back_first();
    }
    return recording_.pauses(stops, checkpoints_, [this](Archive& a) { archive(a); });
  }

  void archive(Archive& a) {
    a.section("steps of variable size");
    a(controller_, pace_, time_, size_, h_, first_of_all_, rejections_, smallest_, largest_, events_, last_event_,
      crowd_);
    recording_.archive(a, options_.objection);
    stepper_.archive_memory(a, state_);
    if (!a.reads()) return;
    recording_.count_from_here();
    a.require(h_ > 0 && std::isfinite(h_) && state_.t <= options_.t_end);
    backup_ = state_;
  }

  void take_back_first() {
    state_ = backup_;
    stepper_.forget(state_);
    time_ = Time(state_.t);
    unproven_ = false;
  }

  // Before the method knows its error: a step that changes little, and leaves two of its kind before the next asked
  // time.
  void start() {
    backup_ = state_;
    controller_.reset();
    events_.start(state_);
    Vector rate(state_.z.size());
    system_.right_hand_side(state_.t, state_.z, rate);
    const double quotient = system_.space->norm(state_.z) / system_.space->norm(rate);
    const double left = std::min(options_.t_end, recording_.next_time()) - state_.t;
    h_ = options_.first_h > 0                      ? options_.first_h
         : std::isfinite(quotient) && quotient > 0 ? controller_.first_share() * quotient
                                                   : 1e-3;
    h_ = bounded(StepController::rounded(std::min(h_, std::max(left, options_.t_end * epsilon) / 3)));
    first_of_all_ = h_;
  }

  double bounded(double h) const { return options_.largest_h > 0 ? std::min(h, options_.largest_h) : h; }

  // One accepted step, or an attempt that was not; false: the run is over.
  bool advance() {
    const double left = options_.t_end - state_.t;
    const bool is_last = h_ * (1 + 1e-10) >= left;
    // What is left is cut in two equal parts before it, so that no step is far shorter than the one before.
    const bool is_cut = !is_last && 2 * h_ > left;
    const bool is_left =
        std::abs(h_ - left) <= 8 * epsilon * std::max(std::abs(options_.t_end), left);  // but for round-off in t
    const double h = is_last && !is_left ? left : is_cut ? left / 2 : h_;
    StepReport step = stepper_.attempt(state_, h);
    recording_.count(step);
    if (!step.solved()) return reject(StepController::rounded(h / 4), step.message);
    const std::optional<double> error = stepper_.error(state_);
    const double unknowns = system_.space->sum(static_cast<double>(state_.z.size()));
    const double noise = 8 * epsilon * system_.space->norm(state_.z) / std::sqrt(unknowns);
    if (!error) {
      const double quadrature_error = stepper_.quadrature_error(state_);
      if (quadrature_error > noise && !controller_.accepts(quadrature_error, h, noise)) {
        stepper_.undo(state_);
        return reject(controller_.next(h), too_inaccurate(h, quadrature_error));
      }
      if (!is_last) return hold_back(h, step);
    }
    if (error && !controller_.accepts(*error, h, noise)) {
      stepper_.undo(state_);
      return reject(controller_.next(h), too_inaccurate(h, *error));
    }
    if (error) step.replaced = {};  // what a projection moved it by is part of an error that is small enough
    if (unproven_ && !show_first()) return false;
    recording_.enter(step);
    rejections_ = 0;
    time_.add(h, state_);
    if (is_last) state_.t = options_.t_end;
    note(h);
    if (error) h_ = controller_.next(h);
    h_ = bounded(h_);
    if (is_cut && h_ > h / 1.1) h_ = h;  // the other half, not a power of 2^{1/4} below it
    return accept();
  }

  // The first step of a method with history: the next one tells its error. It must not hold an event, since what
  // follows one would have to be taken back too.
  bool hold_back(double h, const StepReport& step) {
    if (h > least_step() * 1e3 && events_.any_crossing(state_, [this](double t, Vector& z) { look_inside(t, z); })) {
      stepper_.undo(state_);
      return reject(StepController::rounded(h / 4), "an event lies in the first step");
    }
    unproven_ = true;
    first_ = state_;
    first_h_ = h;
    first_step_ = step;
    first_step_.replaced = {};  // the next one tells whether its error is accepted
    time_.add(h, state_);
    first_.t = state_.t;
    return true;
  }

  // Errors are judged by what they are per unit of time, which for a single short step may be far from the tolerance.
  std::string too_inaccurate(double h, double error) const {
    return fmt::format(
        "the last one, of h = {:.3g} at t = {:.9g}, has an error of {:.3g}, which is {:.3g} per unit of time, and tolerance = "
        "{:.3g} allows {:.3g} per unit of time; a larger tolerance may do, and where none does, the solution blows up or "
        "jumps here",
        h, state_.t, error, error / h, options_.tolerance, controller_.allowed());
  }

  double least_step() const { return 16 * epsilon * std::max(std::abs(state_.t), first_of_all_); }

  bool reject(double next, const std::string& reason) {
    ++recording_.report().rejected;
    if (unproven_) {
      take_back_first();
    } else if (++rejections_ % forget_after == 0) {
      stepper_.forget(state_);
      backup_ = state_;
    }
    if (next < least_step()) {
      recording_.fail_step(fmt::format("no step down to h = {:.3g} will do: {}", next, reason));
      return false;
    }
    h_ = next;
    return true;
  }

  // The step before, which has proved good by the one after it.
  bool show_first() {
    unproven_ = false;
    recording_.enter(first_step_);
    note(first_h_);
    events_.start(first_);
    std::swap(state_, first_);
    const bool good = recording_.record(false);
    std::swap(state_, first_);
    return good;
  }

  void note(double h) {
    smallest_ = std::min(smallest_, h);
    largest_ = std::max(largest_, h);
  }

  bool accept() {
    const EventFinder::Found found = events_.find(state_, [this](double t, Vector& z) { look_inside(t, z); });
    show_until(found.empty() ? state_.t : found.t);
    if (found.empty()) return recording_.record(state_.t >= options_.t_end);

    State at = state_;
    if (found.t != state_.t) stepper_.interpolate(state_, found.t, at);
    std::swap(state_, at);
    return !crowds(found.t) && happen(found);
  }

  bool happen(const EventFinder::Found& found) {
    const bool goes_on = found.happen(state_, recording_.report().events);
    stepper_.restart(state_);
    time_ = Time(state_.t);
    recording_.reopen();
    if (!recording_.record(!goes_on) || !goes_on) return false;
    start();
    return true;
  }

  // A ball that bounces to rest does so infinitely often in a finite time.
  bool crowds(double t) {
    constexpr int most = 1000;
    constexpr double apart = 1e-7;  // of the run
    const bool is_next = t - last_event_ < apart * std::abs(options_.t_end);
    last_event_ = t;
    crowd_ = is_next ? crowd_ + 1 : 0;
    if (crowd_ < most) return false;
    recording_.fail_step(
        fmt::format("events accumulate at t = {:.9g}: {} of them, each within {:.3g} of the one before; an action that "
                    "ends them, or the run, is needed there",
                    t, most, apart * std::abs(options_.t_end)));
    return true;
  }

  void show_until(double t) {
    for (double next = recording_.next_time(); next <= t; next = recording_.next_time()) {
      if (next != state_.t) stepper_.interpolate(state_, next, between_);
      recording_.show(next == state_.t ? state_ : between_);
    }
  }

  void look_inside(double t, Vector& z) {
    stepper_.interpolate(state_, t, between_);
    z = between_.z;
  }

  // t by compensated summation (Kahan): steps are short and many.
  class Time {
   public:
    explicit Time(double t) : t_(t) {}
    void add(double h, State& state) {
      const double y = h - low_;
      const double sum = t_ + y;
      low_ = (sum - t_) - y;
      state.t = t_ = sum;
    }
    void archive(Archive& a) { a(t_, low_); }

   private:
    double t_, low_ = 0;
  };

  const System& system_;
  AdaptiveStepper& stepper_;
  State& state_;
  const AdaptiveOptions& options_;
  Recording& recording_;
  StepController controller_;
  EventFinder events_;
  Checkpoints* checkpoints_;
  RunPace pace_;
  Time time_;
  double size_;  // the largest number of the initial state
  double h_ = 0;
  double first_of_all_ = 0;  // h of the first attempt since the start, or the last event
  int rejections_ = 0;       // since the last accepted step
  bool unproven_ = false;    // is there a first step whose error is not known yet?
  State backup_, first_;     // before it, and after
  State between_;            // inside the last step
  double first_h_ = 0;
  double last_event_ = -std::numeric_limits<double>::infinity();
  int crowd_ = 0;  // of events, each soon after the one before
  StepReport first_step_;
  double smallest_ = std::numeric_limits<double>::infinity(), largest_ = 0;
};

}  // namespace

RunReport integrate_adaptive(const System& system, AdaptiveStepper& stepper, State& state,
                             const AdaptiveOptions& options, std::span<Observer* const> observers) {
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance))
    throw Error("the tolerance must be finite and > 0, but it is {}", options.tolerance);
  if (!std::isfinite(options.t_end) || options.t_end < state.t)
    throw Error("t_end = {} must not lie before the start t = {}", options.t_end, state.t);
  for (const double h : {options.first_h, options.largest_h})
    if (!std::isfinite(h) || h < 0)
      throw Error("the first and the largest step size must be finite and ≥ 0, but one is {}", h);
  Recording recording(system, stepper, state, options.law, options.explanation, observers);
  AdaptiveLoop loop(system, stepper, state, options, recording);
  const StopRequest stoppable(options.stop);
  try {
    loop.run();
  } catch (const Stopped&) {
    recording.interrupt_inside_step(options.t_end);
  } catch (const Error& error) {
    recording.abandon(error.what());
  }
  return recording.finish(options.objection, loop.remark());
}

RunReport integrate_either(const System& system, Stepper& stepper, AdaptiveStepper* adaptive, State& state,
                           const AdaptiveOptions& options, std::span<Observer* const> observers) {
  if (adaptive != nullptr) return integrate_adaptive(system, *adaptive, state, options, observers);
  return integrate(system, stepper, state,
                   {.h = options.first_h,
                    .t_end = options.t_end,
                    .law = options.law,
                    .objection = options.objection,
                    .explanation = options.explanation,
                    .stop = options.stop,
                    .events = options.events,
                    .resumption = options.resumption},
                   observers);
}

}  // namespace seiche
