#include <seiche/config/simulation.hpp>
#include <seiche/core/error.hpp>

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

const BackendEntry& choose_backend(const std::string& name, const Problem& problem) {
  return name == "auto" ? automatic_backend(problem) : find_backend(name);
}

}  // namespace

Simulation::Simulation(const Problem& problem, const SimulationOptions& options)
    : method_(find_method(options.method)), problem_(as_integrated(method_, problem)) {
  const BackendEntry& backend = choose_backend(options.backend, problem_);
  backend_name_ = backend.name;
  system_ = backend.system(problem_, options.backend_options);
  stepper_ = make_stepper(method_, system_, options.method_options);
  restart();
}

void Simulation::restart() {
  state_ = State{};
  state_.z = system_.initial;
  stepper_->begin(state_);
}

}  // namespace seiche
