#include <seiche/core/base/error.hpp>
#include <seiche/petsc/ts_run.hpp>
#include <seiche/simulation/dense_output.hpp>

#include <petsc/private/petscimpl.h>

#include <limits>

namespace seiche {

TsRun::TsRun(TS ts, const TsFormulation& formulation, TsOptions options, Vec u)
    : ts_(ts), formulation_(formulation), options_(std::move(options)) {
  make(u);
}

void TsRun::make(Vec u) {
  simulation_.reset();
  equation_.emplace(ts_, formulation_, u, options_.is_separable);
  simulation_ = std::make_unique<Simulation>(equation_->problem(), options_.simulation);
  is_under_way_ = false;
}

void TsRun::follow(Vec u, double t, bool restart) {
  PetscObjectState changes = 0;
  require(PetscObjectStateGet(reinterpret_cast<PetscObject>(u), &changes));
  State& state = simulation_->state();
  if (is_under_way_ && !restart) {
    state.t = t;  // as PETSc has added up its steps
    if (changes == left_at_) return;
    Vector z;
    equation_->to_state(u, z);
    left_at_ = changes;
    if (z == state.z) return;
  }
  equation_->to_state(u, state.z);
  state.t = t;
  if (options_.simulation.variable_steps && is_under_way_)
    simulation_->adaptive_stepper().restart(state);
  else
    simulation_->stepper().begin(state);
  is_under_way_ = true;
  left_at_ = changes;
}

StepReport TsRun::attempt(double h) {
  State& state = simulation_->state();
  equation_->hold_momenta(state.z);
  return options_.simulation.variable_steps ? simulation_->adaptive_stepper().attempt(state, h)
                                            : simulation_->stepper().step(state, h);
}

StepReport TsRun::step(double h, Vec u) {
  if (!(h > 0)) throw Error("the time step {} must be > 0: what friction takes does not come back", h);
  const double t = simulation_->state().t;
  before_ = simulation_->state();
  StepReport report;
  try {
    report = attempt(h);
  } catch (const SupportGrew&) {
    options_.is_separable = false;
    make(u);
    follow(u, t, true);
    before_ = simulation_->state();
    report = attempt(h);
  }
  if (!report.solved()) return report;
  if (options_.simulation.variable_steps) learn_error(h);
  equation_->to_solution(simulation_->state().z, u);
  require(PetscObjectStateGet(reinterpret_cast<PetscObject>(u), &left_at_));
  return report;
}

// A method with history knows nothing of the error of its first step: the next one of the same length tells it.
void TsRun::learn_error(double h) {
  AdaptiveStepper& stepper = simulation_->adaptive_stepper();
  error_ = stepper.error(simulation_->state());
  looked_ahead_ = !error_;
  if (error_) return;
  error_ = std::numeric_limits<double>::infinity();
  State ahead = simulation_->state();
  if (!stepper.attempt(ahead, h).solved()) return;
  error_ = stepper.error(ahead).value_or(*error_);
  stepper.undo(ahead);
}

void TsRun::undo(Vec u) {
  State& state = simulation_->state();
  if (options_.simulation.variable_steps && !looked_ahead_) {
    simulation_->adaptive_stepper().undo(state);
  } else {
    state = before_;
    if (looked_ahead_) simulation_->adaptive_stepper().forget(state);
  }
  equation_->to_solution(state.z, u);
  require(PetscObjectStateGet(reinterpret_cast<PetscObject>(u), &left_at_));
}

void TsRun::interpolate(double t, Vec u) {
  const State& state = simulation_->state();
  Vector z = state.z;
  AdaptiveStepper* adaptive = options_.simulation.variable_steps ? &simulation_->adaptive_stepper() : nullptr;
  if (adaptive != nullptr && !looked_ahead_)
    adaptive->interpolate(state, t, z);
  else if (t < state.t)
    z = StepReplay(simulation_->stepper(), adaptive).at({before_, state.t - before_.t}, t).z;
  equation_->to_solution(z, u);
}

}  // namespace seiche
