#include <seiche/core/error.hpp>
#include <seiche/run/integrate.hpp>
#include <seiche/run/recording.hpp>
#include <seiche/run/time_grid.hpp>

#include <string>

namespace seiche {
namespace {

// Steps between two looks for NaN where nothing is recorded: rare enough to cost nothing.
constexpr std::int64_t finite_check_every = 64;

void loop(Recording& recording, Stepper& stepper, State& state, const TimeGrid& grid, const std::atomic<bool>* stop) {
  if (!recording.record(grid.steps == 0)) return;
  for (std::int64_t k = 1; k <= grid.steps; ++k) {
    if (stop && stop->load(std::memory_order_relaxed)) return recording.interrupt(grid.end);
    const StepReport step = stepper.step(state, grid.step_size(k));
    recording.count(step);
    if (!step.solved()) return recording.fail_step(step.message);
    recording.enter(step.ledger);
    state.n = recording.first_n() + k;
    state.t = grid.time(k);
    const bool last = k == grid.steps;
    if (last || recording.anyone_due()) {
      if (!recording.record(last)) return;
    } else if (k % finite_check_every == 0 && !recording.check_finite()) {
      return;
    }
  }
}

std::string remark(const TimeGrid& grid) {
  if (!grid.last_is_shortened()) return "";
  return fmt::format("; h = {:.9g} does not divide the time {:.9g}, so the last step was shortened to {:.9g}", grid.h,
                     grid.end - grid.start, grid.last_h);
}

}  // namespace

RunReport integrate(const System& system, Stepper& stepper, State& state, const IntegrateOptions& options,
                    std::span<Observer* const> observers) {
  const TimeGrid grid(state.t, options.h, options.t_end);
  Recording recording(system, stepper, state, options.law, observers);
  try {
    loop(recording, stepper, state, grid, options.stop);
  } catch (const Error& error) {  // a propagator that does not exist, a disk that is full
    recording.abandon(error.what());
  }
  return recording.finish(options.objection, remark(grid));
}

}  // namespace seiche
