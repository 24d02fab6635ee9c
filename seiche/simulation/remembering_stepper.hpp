// A method that remembers its steps, so that the solution inside them can be found again.
#pragma once

#include <seiche/core/stepper.hpp>

#include <vector>

namespace seiche {

// State says that nothing which evolves hides elsewhere: the state before a step and its length are all of the step.
struct TakenStep {
  State left;
  double h = 0.0;
  void archive(Archive& a) { a(left, h); }
};

// Passes everything on to `stepper`, and notes the steps that stand. Of what was taken back nothing is left: a step
// begins where an earlier one ended, or takes its place.
class RememberingStepper final : public AdaptiveStepper {
 public:
  enum class Keeps { none, last, all };
  // `adaptive` is the same stepper where it tells its errors, or null: then only what a Stepper has may be asked for.
  RememberingStepper(Stepper& stepper, AdaptiveStepper* adaptive, Keeps keeps)
      : stepper_(stepper), adaptive_(adaptive), keeps_(keeps) {}

  const std::vector<TakenStep>& taken() const { return taken_; }  // in the order of time; at most one for Keeps::last
  std::vector<TakenStep> release(double t_end);                   // those that begin before t_end
  void archive(Archive& a, const State& like);                    // of states like this one

  void begin(State& state) override { stepper_.begin(state); }
  StepReport step(State& state, double h) override;
  EnergyReading energy(const State& state) const override { return stepper_.energy(state); }
  bool has_modified_energy() const override { return stepper_.has_modified_energy(); }
  void keep_ledger() override { stepper_.keep_ledger(); }
  void expect(double error_rate) override { stepper_.expect(error_rate); }

  int order() const override { return adaptive_->order(); }
  StepReport attempt(State& state, double h) override;
  std::optional<double> error(const State& state) override { return adaptive_->error(state); }
  double quadrature_error(const State& state) override { return adaptive_->quadrature_error(state); }
  void undo(State& state) override;
  void interpolate(const State& state, double t, State& between) override { adaptive_->interpolate(state, t, between); }
  void forget(State& state) override { adaptive_->forget(state); }
  void restart(State& state) override { adaptive_->restart(state); }
  void archive_memory(Archive& a, const State& state) override { adaptive_->archive_memory(a, state); }

 private:
  void note(double h);  // a step from left_

  Stepper& stepper_;
  AdaptiveStepper* adaptive_;
  Keeps keeps_;
  State left_;
  std::vector<TakenStep> taken_;
};

}  // namespace seiche
