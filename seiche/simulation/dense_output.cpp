#include <seiche/core/base/error.hpp>
#include <seiche/simulation/dense_output.hpp>

#include <algorithm>

namespace seiche {

StepReport StepReplay::take_again(const TakenStep& step) {
  if (h_ == step.h && t_ == step.left.t) return {};
  h_ = 0;
  right_ = step.left;
  StepReport report = adaptive_->attempt(right_, step.h);
  if (!report.solved()) return report;
  h_ = step.h;
  t_ = step.left.t;
  return report;
}

State StepReplay::at(const TakenStep& step, double t) {
  State state = step.left;
  if (t <= step.left.t) return state;
  const bool shorter = adaptive_ == nullptr || stepper_.has_modified_energy();
  const StepReport report = shorter ? stepper_.step(state, t - step.left.t) : take_again(step);
  if (!report.solved())
    throw Error("the solution at t = {:.9g} is not known, since a step to it failed: {}", t, report.message);
  if (!shorter) adaptive_->interpolate(right_, t, state);
  state.t = t;
  return state;
}

DenseOutput::DenseOutput(std::shared_ptr<Simulation> simulation, bool variable_steps, std::vector<TakenStep> steps,
                         State end)
    : simulation_(std::move(simulation)),
      steps_(std::move(steps)),
      end_(std::move(end)),
      replay_(simulation_->stepper(), variable_steps ? &simulation_->adaptive_stepper() : nullptr) {}

Index DenseOutput::size() const { return simulation_->system().space->physical_size(); }

void DenseOutput::evaluate(std::span<const double> times, std::span<double> values) const {
  const std::lock_guard<std::mutex> lock(turn_);
  Vector physical(size());
  auto out = values.begin();
  for (const double t : times) {
    if (!(t >= t_start() && t <= t_end()))
      throw Error("t = {} is outside the run, which went from {} to {}", t, t_start(), t_end());
    const auto after = std::upper_bound(steps_.begin(), steps_.end(), t,
                                        [](double time, const TakenStep& step) { return time < step.left.t; });
    const bool is_end = t == t_end() || after == steps_.begin();
    simulation_->system().space->to_physical(is_end ? end_.z : replay_.at(*std::prev(after), t).z, physical);
    out = std::copy(physical.begin(), physical.end(), out);
  }
}

}  // namespace seiche
