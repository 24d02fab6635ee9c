// The solution of a run at any time of it.
#pragma once

#include <seiche/simulation/remembering_stepper.hpp>
#include <seiche/simulation/simulation.hpp>

#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace seiche {

// States inside steps that were taken: with variable steps on the solution that the method has there, found by taking
// the step again; with steps of one size, and where the method has a modified energy, by a shorter step from its left
// end.
class StepReplay {
 public:
  // `adaptive` is the same stepper, or null for steps of one size.
  StepReplay(Stepper& stepper, AdaptiveStepper* adaptive) : stepper_(stepper), adaptive_(adaptive) {}

  // `t` must not lie before the step. Several times in one step, one after the other, take it once. Throws Error where
  // it fails.
  State at(const TakenStep& step, double t);

 private:
  StepReport take_again(const TakenStep& step);

  Stepper& stepper_;
  AdaptiveStepper* adaptive_;
  double t_ = 0.0, h_ = 0.0;  // of the step taken again last; h = 0: none
  State right_;               // its end
};

// Evaluations take turns, so several threads may share one.
class DenseOutput {
 public:
  // The steps of a run with `simulation`, which nothing else uses any more, in the order of time, and its end.
  DenseOutput(std::shared_ptr<Simulation> simulation, bool variable_steps, std::vector<TakenStep> steps, State end);

  double t_start() const { return steps_.empty() ? end_.t : steps_.front().left.t; }
  double t_end() const { return end_.t; }
  Index size() const;  // of a state: fields × points

  // Physical values, one state of size() after the other. At the time of an event it is the state behind it. Throws
  // Error for a time outside the run.
  void evaluate(std::span<const double> times, std::span<double> values) const;

 private:
  std::shared_ptr<Simulation> simulation_;
  std::vector<TakenStep> steps_;
  State end_;
  mutable std::mutex turn_;
  mutable StepReplay replay_;
};

}  // namespace seiche
