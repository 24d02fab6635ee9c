#include <seiche/core/base/error.hpp>
#include <seiche/core/control/stop_request.hpp>
#include <seiche/loop/event_finder.hpp>
#include <seiche/loop/integrate.hpp>
#include <seiche/loop/recording.hpp>
#include <seiche/loop/time_grid.hpp>

#include <string>

namespace seiche {
namespace {

// Steps between two looks for NaN where nothing is recorded: rare enough to cost nothing.
constexpr std::int64_t finite_check_every = 64;

class FixedLoop {
 public:
  FixedLoop(const System& system, Stepper& stepper, State& state, const IntegrateOptions& options, const TimeGrid& grid,
            Recording& recording)
      : system_(system),
        stepper_(stepper),
        state_(state),
        options_(options),
        grid_(grid),
        recording_(recording),
        events_(options.events),
        checkpoints_(options.resumption.checkpoints) {}

  void run() {
    if (options_.resumption.from != nullptr)
      archive(*options_.resumption.from);
    else if (!begin())
      return;
    while (k_ <= grid_.steps) {
      if (pauses()) return recording_.interrupt(grid_.end);
      if (!advance(k_)) return;
      k_ = restarted_ ? 1 : k_ + 1;
    }
  }

  std::string remark() const {
    if (!grid_.last_is_shortened() || state_.t != grid_.end) return "";
    return fmt::format("; h = {:.9g} does not divide the time {:.9g}{}, so the last step was shortened to {:.9g}",
                       grid_.h, grid_.end - grid_.start, met_event_ ? " behind the last event" : "", grid_.last_h);
  }

 private:
  bool begin() {
    if (!recording_.record(grid_.steps == 0)) return false;
    const EventFinder::Found at_start = events_.begin(system_, state_);
    if (!at_start.empty()) return happen(at_start);
    events_.start(state_);
    return true;
  }

  // True if the run is to stop here. It is saved before that, and at every request.
  bool pauses() {
    const bool stops = options_.stop && options_.stop->load(std::memory_order_relaxed);
    return recording_.pauses(stops, checkpoints_, [this](Archive& a) { archive(a); });
  }

  void archive(Archive& a) {
    a.section("steps of one size");
    a(grid_.start, k_, events_, met_event_);
    recording_.archive(a, options_.objection);
    if (!a.reads()) return;
    grid_ = TimeGrid(grid_.start, grid_.h, grid_.end);
    a.require(k_ >= 1 && k_ <= grid_.steps + 1 && state_.t >= grid_.start && state_.t <= grid_.end);
  }

  // Step k of the grid and what happens in it; false: the run is over.
  bool advance(std::int64_t k) {
    restarted_ = false;
    const std::int64_t n = state_.n + 1;
    if (!options_.events.empty()) left_ = state_;
    const StepReport step = stepper_.step(state_, grid_.step_size(k));
    recording_.count(step);
    if (!step.solved()) {
      recording_.fail_step(step.message);
      return false;
    }
    state_.n = n;
    state_.t = grid_.time(k);
    if (!options_.events.empty()) {
      if (!recording_.check_finite()) return false;
      const EventFinder::Found found = events_.find(state_, [this](double t, Vector& z) {
        between_ = left_;
        shorten(between_, t);
        z = between_.z;
      });
      if (!found.empty()) return meet(found, step);
    }
    recording_.enter(step);
    const bool last = k == grid_.steps;
    if (last || recording_.anyone_due()) return recording_.record(last);
    return n % finite_check_every != 0 || recording_.check_finite();
  }

  // A step of its own from the left end, which ends at t.
  StepReport shorten(State& state, double t) {
    StepReport step = t > state.t ? stepper_.step(state, t - state.t) : StepReport{};
    if (!step.solved()) throw Error("a step to t = {:.9g}, to look for an event, failed: {}", t, step.message);
    return step;
  }

  bool meet(const EventFinder::Found& found, const StepReport& whole) {
    if (found.t < state_.t) {
      const std::int64_t n = state_.n;
      state_ = left_;
      recording_.enter(shorten(state_, found.t));
      state_.n = n;
      state_.t = found.t;
    } else {
      recording_.enter(whole);
    }
    return happen(found);
  }

  bool happen(const EventFinder::Found& found) {
    const bool goes_on = found.happen(state_, recording_.report().events);
    stepper_.begin(state_);
    recording_.reopen();
    grid_ = TimeGrid(state_.t, grid_.h, grid_.end);
    restarted_ = met_event_ = true;
    if (!recording_.record(!goes_on || grid_.steps == 0) || !goes_on) return false;
    events_.start(state_);
    return true;
  }

  const System& system_;
  Stepper& stepper_;
  State& state_;
  const IntegrateOptions& options_;
  TimeGrid grid_;
  Recording& recording_;
  EventFinder events_;
  Checkpoints* checkpoints_;
  std::int64_t k_ = 1;    // the next step of the grid
  State left_, between_;  // where there are events
  bool restarted_ = false, met_event_ = false;
};

}  // namespace

RunReport integrate(const System& system, Stepper& stepper, State& state, const IntegrateOptions& options,
                    std::span<Observer* const> observers) {
  const TimeGrid grid(state.t, options.h, options.t_end);
  Recording recording(system, stepper, state, options.law, options.explanation, observers);
  FixedLoop loop(system, stepper, state, options, grid, recording);
  const StopRequest stoppable(options.stop);
  try {
    loop.run();
  } catch (const Stopped&) {
    recording.interrupt_inside_step(options.t_end);
  } catch (const Error& error) {  // a propagator that does not exist, a disk that is full
    recording.abandon(error.what());
  }
  return recording.finish(options.objection, loop.remark());
}

}  // namespace seiche
