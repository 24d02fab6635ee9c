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
};

class TsRun {
 public:
  // Throws Error or PetscFailure as TsEquation and Simulation do.
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
  const Simulation& simulation() const { return *simulation_; }
  LawPromise law(double t_end) const { return promise_energy_law(*simulation_, t_end); }

 private:
  void make(Vec u);
  StepReport attempt(double h);
  void learn_error(double h);

  TS ts_;
  TsFormulation formulation_;
  TsOptions options_;
  std::optional<TsEquation> equation_;
  std::unique_ptr<Simulation> simulation_;
  State before_;  // the last step
  std::optional<double> error_;
  bool looked_ahead_ = false;  // the stepper has taken another step since, and gone back
  bool is_under_way_ = false;
  PetscObjectState left_at_ = 0;  // of u after the last step: PETSc counts its changes
};

}  // namespace seiche
