#include <seiche/core/base/error.hpp>
#include <seiche/core/base/memory_limit.hpp>
#include <seiche/core/simd/thread_count.hpp>
#include <seiche/law/law.hpp>
#include <seiche/noise/noisy_stepper.hpp>
#include <seiche/simulation/auto_method.hpp>
#include <seiche/simulation/run_memory.hpp>
#include <seiche/simulation/simulation.hpp>

namespace seiche {
namespace {

// With noise it is not the method that damps.
Problem as_integrated(const MethodEntry& method, const Problem& problem, const Noise& noise) {
  if (!method.kind.merges_damping || noise.is_on()) return problem;
  try {
    return with_damping_merged(problem);
  } catch (const Error& error) {
    throw Error("{} does not apply: {}", method.name, error.what());
  }
}

bool is_automatic(const SimulationOptions& options) { return options.method == "auto"; }

// Noise is of weak order two, so that no higher order pays.
constexpr std::string_view cheapest = "seisav";

const MethodEntry* given_method(const SimulationOptions& options) {
  if (!is_automatic(options)) return &find_method(options.method);
  return options.noise.is_on() ? &find_method(cheapest) : nullptr;
}

void require_noise_to_fit(const SimulationOptions& options, const MethodEntry& method, const Problem& problem,
                          const BackendEntry& backend) {
  if (options.variable_steps)
    throw Error(
        "noise needs steps of one size: how long a step is must not depend on the numbers drawn; write method.h, and no tolerance");
  if (!problem.has_damping() && options.backend_options.sparse.pade_degree > 0)
    throw Error(
        "noise on a gradient flow is of a size made for e^{{hSM}}, and pade_degree = {} leaves less of it: write 0",
        options.backend_options.sparse.pade_degree);
  if (backend.name == "petsc") throw Error("the backend petsc has no noise; modal, dense and sparse have it");
  if (!problem.has_damping() && method.propagator == PropagatorKind::cayley)
    throw Error(
        "noise on a gradient flow is of a size made for e^{{hSM}}, and {} takes another propagator; use seisav, or another exponential method",
        method.name);
}

// Midpoints remembered from other noise would be wrong by more than the step; r starts anew in each.
MethodOptions options_with_noise(const MethodEntry& method, MethodOptions options) {
  if (method.kind.takes_predictor) options.predictor = Predictor::gradient;
  if (options.auxiliary != AuxiliaryMode::automatic && options.auxiliary != AuxiliaryMode::transport)
    throw Error("auxiliary has no meaning beside noise, which lets r² start from V + C in every step: leave it out");
  options.auxiliary = AuxiliaryMode::transport;
  return options;
}

// Lanczos iteration would ask of M what kicks have no use for.
bool kicks_suit(const SimulationOptions& options) {
  return options.backend_options.sparse.exponential == ExponentialKind::pade;
}

const BackendEntry& choose_backend(const SimulationOptions& options, const Problem& problem,
                                   const MethodOptions& method_options) {
  if (options.backend_options.ranks != nullptr) {
    if (options.backend == "petsc") return find_backend("petsc");
    if (options.backend != "auto" && options.backend != "modal")
      throw Error(
          "the backends modal and petsc run on several processes, and not \"{}\"; write backend = \"modal\" for a grid of two "
          "or three axes, and else \"petsc\"",
          options.backend);
    return find_backend("modal");
  }
  if (options.backend != "auto") return find_backend(options.backend);
  return automatic_backend(problem, method_options.linear == LinearTreatment::explicit_kicks && kicks_suit(options));
}

// Is there a backend for kicks that "auto" may take, or is it the one in use? It runs on one thread, and keeps
// matrices.
bool may_choose_kicks(const SimulationOptions& options, const Problem& problem, const BackendEntry& backend) {
  constexpr Index most_unknowns = Index{1} << 23;
  if (options.backend_options.ranks != nullptr) return false;
  if (backend.exponentials_by_krylov) return kicks_suit(options);
  return options.backend == "auto" && kicks_suit(options) && options.backend_options.threads == 1 &&
         problem.size() <= most_unknowns && &automatic_backend(problem, true) != &backend;
}

void require_memory(const MethodEntry& method, const Problem& problem, const SimulationOptions& options,
                    const BackendEntry& backend) {
  const double bytes =
      (options.is_of_run ? run_bytes : simulation_bytes)(method, backend, problem, options.variable_steps);
  if (bytes > memory_limit())
    throw Error("{} on {} unknowns needs about {:.3g} bytes, but only {:.3g} are available; choose fewer points{}",
                method.name, problem.size(), bytes, memory_limit(),
                method.kind.takes_C ? "" : ", or seisav, which needs the least");
}

void require_gradient(const Problem& problem) {
  if (!problem.potential || problem.initial.size() != problem.size()) return;
  const Index n = problem.grid.unknowns();
  const std::string complaint =
      problem.potential->complaint({problem.initial.data() + problem.potential_field * n,
                                    static_cast<std::size_t>(problem.potential->fields() * n)});
  if (!complaint.empty()) throw Error(complaint);
}

}  // namespace

Simulation::Simulation(const Problem& problem, const SimulationOptions& options)
    : method_(given_method(options)),
      problem_(method_ != nullptr ? as_integrated(*method_, problem, options.noise) : problem),
      method_options_(options.method_options),
      noise_(options.noise) {
  require_thread_count(options.backend_options.threads);
  require_gradient(problem_);
  backend_ = &choose_backend(options, problem_, method_options_);
  if (!options.backend_options.sparse.solver.empty() && backend_->name != "petsc")
    throw Error("solver = \"{}\" is for the backend petsc, and this is {}", options.backend_options.sparse.solver,
                backend_->name);
  if (method_ != nullptr) require_memory(*method_, problem_, options, *backend_);
  if (noise_.is_on()) require_noise_to_fit(options, *method_, problem_, *backend_);
  if (problem_.structure && problem_.initial.size() == problem_.size())
    if (const std::string complaint = problem_.structure->complaint_about(
            {problem_.initial.data(), static_cast<std::size_t>(problem_.initial.size())});
        !complaint.empty())
      throw Error("in the initial state {}", complaint);
  system_ = backend_->system(problem_, options.backend_options);
  if (method_ == nullptr) {
    MethodChoice choice = choose_method(problem_, system_,
                                        {.tolerance = options.tolerance,
                                         .duration = options.duration,
                                         .by_kicks = may_choose_kicks(options, problem_, *backend_),
                                         .by_krylov = backend_->exponentials_by_krylov},
                                        options.method_options);
    method_ = &find_method(choice.method);
    method_options_ = choice.options;
    reason_ = std::move(choice.reason);
    const BackendEntry& better = choose_backend(options, problem_, method_options_);
    if (&better != backend_) {
      backend_ = &better;
      system_ = System{};  // before the other takes its memory
      system_ = better.system(problem_, options.backend_options);
    }
    require_memory(*method_, problem_, options, *backend_);
  }
  if (options.variable_steps && problem_.friction && problem_.friction->smoothness() == Friction::Smoothness::jump)
    throw Error(
        "a tolerance cannot be met with the friction {}, which jumps at v = 0: while a velocity stays there, the error of a "
        "step is of the size of the step; write method.h",
        problem_.friction->text());
  if (noise_.is_on()) {
    if (is_automatic(options)) reason_ = fmt::format("noise is of weak order two, and {} is the cheapest", cheapest);
    method_options_ = options_with_noise(*method_, method_options_);
    auto bath = std::make_unique<Bath>(system_, problem_, noise_);
    stepper_ = with_noise(std::move(bath), make_stepper(*method_, system_, method_options_));
  } else if (options.variable_steps) {
    auto stepper = make_adaptive_stepper(*method_, system_, method_options_);
    adaptive_ = stepper.get();
    stepper_ = std::move(stepper);
  } else {
    stepper_ = make_stepper(*method_, system_, method_options_);
  }
  restart();
}

AdaptiveStepper& Simulation::adaptive_stepper() {
  if (adaptive_ == nullptr) throw Error("this simulation was made for steps of one size; set variable_steps");
  return *adaptive_;
}

void Simulation::restart() {
  state_ = State{};
  state_.z = system_.initial;
  stepper_->begin(state_);
}

LawPromise promise_energy_law(const Simulation& simulation, double t_end) {
  const std::string objection = simulation.method_options().objection(simulation.method());
  LawPromise promise = promise_energy_law(simulation.problem(), t_end);
  if (!objection.empty()) promise.withdraw(objection);
  if (simulation.noise().is_on()) return {.promised = false, .reason = objection_of_noise(simulation.noise())};
  const std::string of_solver = objection_of_solver(simulation.system(), simulation.method());
  if (!of_solver.empty()) promise.withdraw(of_solver);
  return promise;
}

bool has_modified_energy(const SimulationOptions& options) {
  return find_method(options.method).kept_energy == "H_modified" && !options.noise.is_on();
}

std::string objection_of_noise(const Noise& noise) {
  return noise.is_on()
             ? fmt::format("noise of the temperature {:.6g} feeds energy as well as it takes", noise.temperature)
             : "";
}

std::string objection_of_solver(const System& system, const MethodEntry& method) {
  if (!system.linear->solver_share() || method.projects()) return "";
  if (!is_skew(system))
    return "the linear solver stops at its tolerance, and what that misses is restored for a skew S alone";
  if (method.kind.closure == "avf") return "the linear solver stops at its tolerance, and so does the equation of avf";
  return "";
}

}  // namespace seiche
