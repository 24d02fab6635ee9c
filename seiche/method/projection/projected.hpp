// Steps that keep a law of H by projection, whatever computed them.
#pragma once

#include <seiche/core/step_cache.hpp>
#include <seiche/core/stepper.hpp>
#include <seiche/method/common/energy_law.hpp>
#include <seiche/method/common/nonlinear_force.hpp>
#include <seiche/method/projection/base_step.hpp>
#include <seiche/method/projection/damping_strength.hpp>
#include <seiche/method/projection/energy_projection.hpp>

#include <memory>
#include <optional>

namespace seiche {

// ẑ of a base step, moved to the energy of energy_target. Nothing about ẑ enters the proof of the law, so it holds for
// every h: where ẑ is no solution, e^{hL}z takes its place, if it leaves nothing but ∇V out; where it would, and where
// no point near ẑ has an energy that the law allows, the step is taken in halves. A base step that may be solved in
// parts is tried in up to sixteen of them first.
class Projected {
 public:
  // All outlive it.
  Projected(const System& system, const PhiEvaluator& phi, BaseStep& base, EnergyLaw law);

  void begin(State& s);  // throws Error where H of the state is no finite number
  void restart(State& s) { read_energy(s); }
  StepReport step(State& s, double h);
  StepReport attempt(State& s, double h);  // fails where `step` would take e^{hL}z or halves
  void undo(State& s);                     // the last attempt, once
  void keep_ledger() { keeps_ledger_ = true; }
  EnergyReading energy(const State& s) const;

  struct Last {
    double t = 0.0;             // of its start
    double energy = 0.0;        // Hⁿ
    double energy_terms = 0.0;  // of Hⁿ
    double displacement = 0.0;  // Euclidean norm of the projection
    double blur = 0.0;          // what of it round-off in H may have asked for: near rest, where H is flat, much
    bool gained = false;        // damping fed energy somewhere in it
  };
  const Last& last() const { return last_; }   // the step taken last
  const Vector& before() const { return z_; }  // its zⁿ
  // z inside the last step ← a point near it with an energy between both ends
  void keep_between(const State& s, Vector& z);

 private:
  enum class Taken {
    whole,         // the step was taken
    unresolved,    // not: ẑ is no solution
    inadmissible,  // not: no point near ẑ has an energy that the law allows
  };
  void read_energy(State& s) const;
  Taken take(State& s, double t, double h, bool strict, StepReport& report);
  Taken take_without_law(State& s, double t, double h, StepReport& report);
  void prepare(double h);
  StepDissipation::Amount measure_dissipation(const State& s, double t, double h, double computed);
  EnergyTarget choose_energy(const State& s, double t, double h, double computed,
                             const StepDissipation::Amount& amount);
  std::optional<EnergyProjection::Outcome> flow_freely(const State& s, double h);
  Taken end_with(State& s, double t, double h, const EnergyTarget* target, const StepDissipation::Amount& amount,
                 const EnergyProjection::Outcome& outcome, StepReport& report);
  const PhiMap& free_map(double h);
  void commit(State& s, double t, double h, bool resolved, const StepDissipation::Amount& amount,
              const EnergyProjection::Outcome& outcome, StepReport& report);
  bool has_grown_beyond_reason(const EnergyProjection::Outcome& outcome, const State& s, double t, double h);
  void note_replaced(StepReport& report, const State& s, std::string_view why) const;
  bool take_halves(State& s, double t, double h, int depth, bool strict, StepReport& report);
  void fail(StepReport& report, const State& s, double h, Taken taken, int halvings) const;

  const System& system_;
  const PhiEvaluator& phi_;
  BaseStep& base_;
  EnergyLaw law_;
  bool may_flow_freely_;  // e^{hL}z leaves out neither a force nor friction
  bool feeds_;            // Q is a form of z that is negative somewhere: H may rise in any step
  bool rests_;            // a gradient flow without other damping
  EnergyProjection projection_;
  DampingStrength rate_;
  StepCache<PhiMap> free_;  // e^{hL}z
  Vector z_;                // ẑ, then zⁿ
  State saved_;
  Last last_;
  std::unique_ptr<NonlinearForce> force_;  // made when it is first asked for
  bool keeps_ledger_ = false;
};

// A base step with its law as a method. `system` outlives it; `phi` is the evaluator that the base step refers to.
class ProjectedStepper final : public Stepper {
 public:
  ProjectedStepper(const System& system, std::unique_ptr<PhiEvaluator> phi, std::unique_ptr<BaseStep> base,
                   EnergyLaw law)
      : phi_(std::move(phi)), base_(std::move(base)), projected_(system, *phi_, *base_, law) {}

  void begin(State& s) override {
    projected_.begin(s);
    base_->remember_nothing(s);
  }
  void restart(State& s) override {
    projected_.restart(s);
    base_->remember_nothing(s);
  }
  StepReport step(State& s, double h) override { return projected_.step(s, h); }
  StepReport attempt(State& s, double h) { return projected_.attempt(s, h); }
  double blur() const { return projected_.last().blur; }
  EnergyReading energy(const State& s) const override { return projected_.energy(s); }
  bool has_modified_energy() const override { return false; }
  void keep_ledger() override { projected_.keep_ledger(); }

 private:
  std::unique_ptr<PhiEvaluator> phi_;
  std::unique_ptr<BaseStep> base_;
  Projected projected_;
};

}  // namespace seiche
