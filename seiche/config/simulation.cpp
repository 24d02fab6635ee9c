#include <seiche/config/auto_method.hpp>
#include <seiche/config/run_memory.hpp>
#include <seiche/config/simulation.hpp>
#include <seiche/core/error.hpp>
#include <seiche/core/physical_memory.hpp>

namespace seiche {
namespace {

Problem as_integrated(const MethodEntry& method, const Problem& problem) {
  if (method.composition != Composition::whole) return problem;
  try {
    return with_damping_merged(problem);
  } catch (const Error& error) {
    throw Error("{} does not apply: {}", method.name, error.what());
  }
}

bool is_automatic(const SimulationOptions& options) { return options.method == "auto"; }

const BackendEntry& choose_backend(const std::string& name, const Problem& problem, const MethodOptions& options) {
  const bool by_kicks = options.linear == LinearTreatment::explicit_kicks;
  return name == "auto" ? automatic_backend(problem, by_kicks) : find_backend(name);
}

void require_memory(const MethodEntry& method, const Problem& problem, bool variable_steps) {
  const double bytes = run_bytes(method, problem, variable_steps);
  if (bytes > physical_memory())
    throw Error("{} on {} unknowns needs about {:.3g} bytes, and this machine has {:.3g}; choose fewer points{}",
                method.name, problem.size(), bytes, physical_memory(),
                method.closure == ClosureKind::sav ? "" : ", or seisav, which needs the least");
}

}  // namespace

Simulation::Simulation(const Problem& problem, const SimulationOptions& options)
    : method_(is_automatic(options) ? nullptr : &find_method(options.method)),
      problem_(method_ != nullptr ? as_integrated(*method_, problem) : problem),
      method_options_(options.method_options) {
  const BackendEntry& backend = choose_backend(options.backend, problem_, method_options_);
  backend_name_ = backend.name;
  if (method_ != nullptr) require_memory(*method_, problem_, options.variable_steps);
  system_ = backend.system(problem_, options.backend_options);
  if (method_ == nullptr) {
    const bool by_kicks = options.backend == "auto" && automatic_backend(problem_, true).name != backend_name_;
    MethodChoice choice = choose_method(problem_, system_, options.tolerance, options.method_options, by_kicks);
    method_ = &find_method(choice.method);
    method_options_ = choice.options;
    reason_ = std::move(choice.reason);
    const BackendEntry& better = choose_backend(options.backend, problem_, method_options_);
    if (better.name != backend_name_) {
      backend_name_ = better.name;
      system_ = better.system(problem_, options.backend_options);
    }
    require_memory(*method_, problem_, options.variable_steps);
  }
  if (options.variable_steps && problem_.friction && problem_.friction->smoothness() == Friction::Smoothness::jump)
    throw Error(
        "a tolerance cannot be met with the friction {}, which jumps at v = 0: while a velocity stays there, the error of a "
        "step is of the size of the step; write method.h",
        problem_.friction->text());
  if (options.variable_steps) {
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

}  // namespace seiche
