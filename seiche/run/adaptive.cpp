#include <seiche/core/error.hpp>
#include <seiche/run/adaptive.hpp>
#include <seiche/run/event_finder.hpp>
#include <seiche/run/recording.hpp>
#include <seiche/run/step_controller.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

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
        time_(state.t) {}

  void run() {
    if (!recording_.record(state_.t >= options_.t_end)) return;
    events_.start(state_);
    start();
    while (state_.t < options_.t_end) {
      if (options_.stop && options_.stop->load(std::memory_order_relaxed)) return recording_.interrupt(options_.t_end);
      if (!advance()) return;
    }
  }

  std::string remark() const {
    return fmt::format(" of {:.3g} to {:.3g}, {} rejected", smallest_, largest_, recording_.report().rejected);
  }

 private:
  // Before the method knows its error: a step that changes little, and leaves two of its kind before the next asked time.
  void start() {
    backup_ = state_;
    controller_.reset();
    Vector rate(state_.z.size());
    system_.right_hand_side(state_.t, state_.z, rate);
    const double quotient = state_.z.norm() / rate.norm();
    const double left = std::min(options_.t_end, recording_.next_time()) - state_.t;
    h_ = options_.first_h > 0 ? options_.first_h : std::isfinite(quotient) && quotient > 0 ? 0.02 * quotient : 1e-3;
    h_ = StepController::rounded(std::min(h_, std::max(left, options_.t_end * epsilon) / 3));
  }

  // One accepted step, or an attempt that was not; false: the run is over.
  bool advance() {
    const double left = options_.t_end - state_.t;
    const bool is_last = h_ * (1 + 1e-10) >= left;
    // What is left is cut in two equal parts before it, so that no step is far shorter than the one before.
    if (!is_last && 2 * h_ > left) h_ = left / 2;
    const double h = is_last && std::abs(h_ - left) > 1e-10 * left ? left : h_;
    const StepReport step = stepper_.attempt(state_, h);
    recording_.count(step);
    if (!step.solved()) return reject(StepController::rounded(h / 4), step.message);
    const std::optional<double> error = stepper_.error(state_);
    if (!error && !is_last) {  // the first step of a method with history: the next one tells
      unproven_ = true;
      first_ = state_;
      time_.add(h, state_);
      return true;
    }
    const double noise = 8 * epsilon * state_.z.norm() / std::sqrt(static_cast<double>(state_.z.size()));
    if (error && !controller_.accepts(*error, h, noise)) {
      stepper_.undo(state_);
      return reject(controller_.next(h),
                    fmt::format("its error is {:.3g} and {:.3g} is asked for", *error, options_.tolerance));
    }
    if (unproven_ && !show_first()) return false;
    rejections_ = 0;
    time_.add(h, state_);
    if (is_last) state_.t = options_.t_end;
    smallest_ = std::min(smallest_, h);
    largest_ = std::max(largest_, h);
    if (error) h_ = controller_.next(h);
    return accept();
  }

  bool reject(double next, const std::string& reason) {
    ++recording_.report().rejected;
    if (unproven_) {
      state_ = backup_;
      stepper_.restart(state_);
      time_ = Time(state_.t);
      unproven_ = false;
    } else if (++rejections_ % 8 == 0) {  // what the method remembers does not help any more
      stepper_.restart(state_);
      backup_ = state_;
    }
    const double least = 16 * epsilon * std::max(std::abs(state_.t), 1e-3 * options_.t_end);
    if (next < least) {
      recording_.fail_step(fmt::format("no step down to h = {:.3g} will do: {}", next, reason));
      return false;
    }
    h_ = next;
    return true;
  }

  // The step before, which has proved good by the one after it.
  bool show_first() {
    unproven_ = false;
    std::swap(state_, first_);
    const bool good = recording_.record(false);
    std::swap(state_, first_);
    return good;
  }

  bool accept() {
    const EventFinder::Found found = events_.find(state_, stepper_);
    const double until = found.event != nullptr ? found.t : state_.t;
    show_until(until);
    if (found.event == nullptr) return recording_.record(state_.t >= options_.t_end);

    State at = state_;
    at.t = found.t;
    stepper_.interpolate(state_, found.t, at.z);
    std::swap(state_, at);
    recording_.report().events.push_back(found.t);
    const bool goes_on = found.event->action && found.event->action(state_);
    stepper_.restart(state_);
    time_ = Time(state_.t);
    if (!recording_.record(!goes_on) || !goes_on) return false;
    events_.start(state_);
    start();
    return true;
  }

  void show_until(double t) {
    for (double next = recording_.next_time(); next <= t; next = recording_.next_time()) {
      State between;
      between.n = state_.n;
      between.t = next;
      between.r_squared = state_.r_squared;
      between.shift = state_.shift;
      between.z.resizeLike(state_.z);
      stepper_.interpolate(state_, next, between.z);
      recording_.show(between);
    }
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
  Time time_;
  double h_ = 0;
  int rejections_ = 0;     // since the last accepted step
  bool unproven_ = false;  // is there a first step whose error is not known yet?
  State backup_, first_;   // before it, and after
  double smallest_ = std::numeric_limits<double>::infinity(), largest_ = 0;
};

}  // namespace

RunReport integrate_adaptive(const System& system, AdaptiveStepper& stepper, State& state,
                             const AdaptiveOptions& options, std::span<Observer* const> observers) {
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance))
    throw Error("the tolerance must be finite and > 0, but it is {}", options.tolerance);
  if (!std::isfinite(options.t_end) || options.t_end < state.t)
    throw Error("t_end = {} must not lie before the start t = {}", options.t_end, state.t);
  if (!std::isfinite(options.first_h) || options.first_h < 0)
    throw Error("the first step size must be finite and ≥ 0, but it is {}", options.first_h);
  Recording recording(system, stepper, state, options.law, observers);
  AdaptiveLoop loop(system, stepper, state, options, recording);
  try {
    loop.run();
  } catch (const Error& error) {
    recording.abandon(error.what());
  }
  return recording.finish(options.objection, loop.remark());
}

}  // namespace seiche
