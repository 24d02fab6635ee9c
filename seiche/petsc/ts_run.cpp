#include <seiche/core/base/error.hpp>
#include <seiche/mpi/mpi_ranks.hpp>
#include <seiche/petsc/joint_potential.hpp>
#include <seiche/petsc/petsc_damping.hpp>
#include <seiche/petsc/petsc_law.hpp>
#include <seiche/petsc/ts_run.hpp>
#include <seiche/simulation/dense_output.hpp>

#include <petsc/private/petscimpl.h>

#include <array>
#include <limits>

namespace seiche {

TsRun::TsRun(TS ts, const TsFormulation& formulation, TsOptions options, Vec u)
    : ts_(ts), formulation_(formulation), options_(std::move(options)) {
  make(u);
}

void TsRun::make(Vec u) {
  try {
    build(u);
  } catch (const SupportGrew&) {
    options_.is_separable = false;
    build(u);
  }
}

void TsRun::build(Vec u) {
  simulation_.reset();
  joint_.reset();
  equation_.emplace(ts_, formulation_, u, options_.is_separable);
  is_under_way_ = false;
  int processes = 1;
  MPI_Comm_size(communicator_of(equation_->M()), &processes);
  if (processes > 1 || options_.by_ksp) return make_joint(u);
  Vector initial;
  equation_->to_state(u, initial);
  simulation_ = std::make_unique<Simulation>(problem_of(*equation_, initial), options_.simulation);
}

void TsRun::make_joint(Vec u) {
  const SimulationOptions& options = options_.simulation;
  joint_ = std::make_unique<Joint>();
  joint_->ranks = mpi_ranks(MPI_Comm_c2f(communicator_of(equation_->M())));
  PetscEquation& equation = joint_->equation;
  const char* prefix = nullptr;
  require(TSGetOptionsPrefix(ts_, &prefix));
  equation = {.S = equation_->S(),
              .M = equation_->M(),
              .D = equation_->D(),
              .ranks = joint_->ranks.get(),
              .solver = SolverOptions(std::string(prefix != nullptr ? prefix : "") + "seiche_")};
  require_hypotheses(equation);
  const TsFunctions& functions = *equation_->functions();
  const Potential::Support support{0, functions.has_V() ? functions.support() : 0};
  if (method().kind.merges_damping && equation.D != nullptr)
    merge_damping(equation, support, std::string(method().name), joint_->S_less_D);
  System& system = joint_->system;
  system = petsc_system(equation, row_space(local_rows(equation.M), *equation.ranks), support,
                        options.backend_options.sparse);
  system.potential = joint_potential(equation_->functions(), *system.space);
  system.damping = petsc_damping(equation.D, *system.space, support, equation.solver);
  equation_->to_state(u, system.initial);
  if (const std::string complaint = gradient_complaint(functions, *system.space, system.initial); !complaint.empty())
    throw Error(complaint);
  if (options.variable_steps) {
    auto adaptive = make_adaptive_stepper(method(), system, options.method_options);
    joint_->adaptive = adaptive.get();
    joint_->stepper = std::move(adaptive);
  } else {
    joint_->stepper = make_stepper(method(), system, options.method_options);
  }
  joint_->state.z = system.initial;
  joint_->stepper->begin(joint_->state);
}

EnergyReading TsRun::energy() const { return joint_ ? joint_->stepper->energy(joint_->state) : simulation_->energy(); }

EnergyReading TsRun::energy(Vec u) const {
  Vector z;
  equation_->to_state(u, z);
  if (!system().space->any(z != state().z)) return energy();
  const double H = system().energy(z);
  return {.H = H, .modified = H};
}

LawPromise TsRun::law(double t_end) const {
  if (!joint_) return promise_energy_law(*simulation_, t_end);
  LawPromise promise = promise_energy_law(joint_->equation, system().potential->support(), *system().space);
  const std::string objection = options_.simulation.method_options.objection(method());
  if (!objection.empty()) promise.withdraw(objection);
  const std::string of_solver = objection_of_solver(system(), method());
  if (!of_solver.empty()) promise.withdraw(of_solver);
  return promise;
}

std::string TsRun::solver() const {
  if (!joint_) return std::string(simulation_->backend().name);
  const std::optional<SolverShare> share = system().linear->solver_share();
  if (!share) return "KSP (factors)";
  std::string text = fmt::format("KSP ({} iterations", share->iterations);
  if (share->restored > 0)
    text += fmt::format("; the contract of propagators restored by {:.2g} at most", share->restored);
  return text + ")";
}

void TsRun::follow(Vec u, double t, bool restart) {
  PetscObjectState changes = 0;
  require(PetscObjectStateGet(reinterpret_cast<PetscObject>(u), &changes));
  bool changed = restart || !is_under_way_;
  if (!changed && changes != left_at_) {
    Vector z;
    equation_->to_state(u, z);
    changed = z != state().z;
  }
  left_at_ = changes;
  // What one process has seen, all of them do.
  std::array<double, 2> seen = {changed ? 1.0 : 0.0, equation_->is_current() ? 0.0 : 1.0};
  system().space->max(seen);
  if (seen[1] != 0) make(u);
  State& state = this->state();
  state.t = t;  // as PETSc has added up its steps
  if (seen[0] == 0 && seen[1] == 0) return;
  try {
    equation_->to_state(u, state.z);
    equation_->hold_momenta(state.z);
    if (options_.simulation.variable_steps && is_under_way_)
      adaptive_stepper().restart(state);
    else
      stepper().begin(state);
  } catch (const SupportGrew&) {
    options_.is_separable = false;
    make(u);
    this->state().t = t;
  }
  is_under_way_ = true;
}

StepReport TsRun::attempt(double h) {
  State& state = this->state();
  equation_->hold_momenta(state.z);
  return options_.simulation.variable_steps ? adaptive_stepper().attempt(state, h) : stepper().step(state, h);
}

StepReport TsRun::step(double h, Vec u) {
  if (!(h > 0)) throw Error("the time step {} must be > 0: what friction takes does not come back", h);
  const double t = state().t;
  const auto take = [&] {
    before_ = state();
    StepReport report = attempt(h);
    if (report.solved() && options_.simulation.variable_steps) learn_error(h);
    return report;
  };
  StepReport report;
  try {
    report = take();
  } catch (const SupportGrew&) {
    options_.is_separable = false;
    make(u);
    follow(u, t, true);
    report = take();
  }
  if (!report.solved()) return report;
  equation_->to_solution(state().z, u);
  require(PetscObjectStateGet(reinterpret_cast<PetscObject>(u), &left_at_));
  return report;
}

// A method with history knows nothing of the error of its first step: the next one of the same length tells it.
void TsRun::learn_error(double h) {
  AdaptiveStepper& stepper = adaptive_stepper();
  error_ = stepper.error(state());
  looked_ahead_ = !error_;
  if (error_) return;
  error_ = std::numeric_limits<double>::infinity();
  State ahead = state();
  if (!stepper.attempt(ahead, h).solved()) return;
  error_ = stepper.error(ahead).value_or(*error_);
  stepper.undo(ahead);
}

void TsRun::undo(Vec u) {
  State& state = this->state();
  if (options_.simulation.variable_steps && !looked_ahead_) {
    adaptive_stepper().undo(state);
  } else {
    state = before_;
    if (looked_ahead_) adaptive_stepper().forget(state);
  }
  equation_->to_solution(state.z, u);
  require(PetscObjectStateGet(reinterpret_cast<PetscObject>(u), &left_at_));
}

void TsRun::interpolate(double t, Vec u) {
  const State& state = this->state();
  State between = state;
  AdaptiveStepper* adaptive = options_.simulation.variable_steps ? &adaptive_stepper() : nullptr;
  if (adaptive != nullptr && !looked_ahead_)
    adaptive->interpolate(state, t, between);
  else if (t < state.t)
    between = StepReplay(stepper(), adaptive).at({before_, state.t - before_.t}, t);
  equation_->to_solution(between.z, u);
}

}  // namespace seiche
