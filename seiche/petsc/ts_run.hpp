// The integration of one TS: an equation, a method for it and where it stands.
#pragma once

#include <seiche/core/run_report.hpp>
#include <seiche/petsc/ts_equation.hpp>
#include <seiche/simulation/simulation.hpp>

#include <memory>
#include <optional>
#include <string>

namespace seiche {

struct TsOptions {
  SimulationOptions simulation = {};
  bool is_separable = true;  // momenta are told from positions by the gradient of V: seiche/petsc/ts_equation.hpp
  bool by_ksp = false;       // PETSc's solvers on one process too
};

class TsRun {
 public:
  // Throws Error or PetscFailure as TsEquation, Simulation and petsc_system do.
  TsRun(TS ts, const TsFormulation& formulation, TsOptions options, Vec u);

  // Begins at u where u is not what the last step has left there, or that is asked for.
  void follow(Vec u, double t, bool restart);
  // Of a step that failed u is as it was.
  StepReport step(double h, Vec u);
  void undo(Vec u);                   // the last step, once
  void interpolate(double t, Vec u);  // u ← the solution inside the last step
  // Of the last step, in the max norm: infinite where that is not known, and no step of the same length can follow.
  // Nothing for steps of one size.
  std::optional<double> error() const { return error_; }

  bool takes_variable_steps() const { return options_.simulation.variable_steps; }
  const MethodEntry& method() const { return find_method(options_.simulation.method); }
  const System& system() const { return joint_ ? joint_->system : simulation_->system(); }
  EnergyReading energy() const;
  EnergyReading energy(Vec u) const;  // of another state H alone
  LawPromise law(double t_end) const;
  std::string solver() const;  // "sparse", "KSP (1200 iterations)"

 private:
  // Matrices that several processes hold together, and the stepper for them.
  struct Joint {
    std::unique_ptr<Ranks> ranks;
    OwnedMat S_less_D;  // of methods that merge the damping
    PetscEquation equation;
    System system;
    std::unique_ptr<Stepper> stepper;
    AdaptiveStepper* adaptive = nullptr;
    State state;
  };

  void make(Vec u);  // begins at u
  void build(Vec u);
  void make_joint(Vec u);
  StepReport attempt(double h);
  void learn_error(double h);
  const State& state() const { return joint_ ? joint_->state : simulation_->state(); }
  State& state() { return joint_ ? joint_->state : simulation_->state(); }
  Stepper& stepper() { return joint_ ? *joint_->stepper : simulation_->stepper(); }
  AdaptiveStepper& adaptive_stepper() { return joint_ ? *joint_->adaptive : simulation_->adaptive_stepper(); }

  TS ts_;
  TsFormulation formulation_;
  TsOptions options_;
  std::optional<TsEquation> equation_;
  std::unique_ptr<Simulation> simulation_;  // of one process, or …
  std::unique_ptr<Joint> joint_;            // … of several
  State before_;                            // the last step
  std::optional<double> error_;
  bool looked_ahead_ = false;  // the stepper has taken another step since, and gone back
  bool is_under_way_ = false;
  PetscObjectState left_at_ = 0;  // of u after the last step: PETSc counts its changes
};

}  // namespace seiche
