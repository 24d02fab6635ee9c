// A problem, a backend and a method put together: the way in for C++ programs and for every command.
#pragma once

#include <seiche/backend/backends.hpp>
#include <seiche/core/run_report.hpp>
#include <seiche/method/methods.hpp>
#include <seiche/noise/noise.hpp>

#include <memory>
#include <string>

namespace seiche {

struct SimulationOptions {
  std::string method = "seisav";  // or "auto": choose_method decides. Other commands want a name
  std::string backend = "auto";
  MethodOptions method_options = {};
  BackendOptions backend_options = {};
  bool variable_steps = false;  // a stepper that tells its errors, for integrate_adaptive
  double tolerance = 0.0;       // for method "auto": of values at the end; 0: not known
  double duration = 0.0;        // likewise
  Noise noise = {};             // for steps of one size
  bool is_of_run = false;       // which keeps states and values beside it: memory is to hold those too
};

// Throws Error where the method does not apply to the problem, with the reason, and where the gradient of an own
// potential is not that of V.
class Simulation {
 public:
  explicit Simulation(const Problem& problem, const SimulationOptions& options = {});
  Simulation(const Simulation&) = delete;  // the stepper refers to the system beside it
  Simulation& operator=(const Simulation&) = delete;

  // Back to z₀ at t = 0. Throws Error where the method cannot start there (C too small for a given C).
  void restart();
  StepReport step(double h) { return stepper_->step(state_, h); }

  const State& state() const { return state_; }
  State& state() { return state_; }
  Vector physical() const { return system_.space->physical(state_.z); }
  EnergyReading energy() const { return stepper_->energy(state_); }

  const Problem& problem() const { return problem_; }  // as integrated: with D in S for `whole` methods
  const System& system() const { return system_; }
  Stepper& stepper() { return *stepper_; }
  AdaptiveStepper& adaptive_stepper();  // throws Error unless made with variable_steps
  const MethodEntry& method() const { return *method_; }
  const MethodOptions& method_options() const { return method_options_; }
  const Noise& noise() const { return noise_; }
  const std::string& reason() const { return reason_; }  // why "auto" took this method; else ""
  const BackendEntry& backend() const { return *backend_; }

 private:
  const MethodEntry* method_;
  Problem problem_;
  const BackendEntry* backend_;
  System system_;
  MethodOptions method_options_;
  Noise noise_;
  std::string reason_;
  std::unique_ptr<Stepper> stepper_;
  AdaptiveStepper* adaptive_ = nullptr;  // the same, where it is one
  State state_;
};

// Whether the energy law of its method is promised up to t_end, and why (not). Options of the method may give it up.
LawPromise promise_energy_law(const Simulation& simulation, double t_end);

// True if a run has a modified energy: its method, which is named, carries one, and no noise moves it.
bool has_modified_energy(const SimulationOptions& options);

// Why no law is promised beside noise, or "".
std::string objection_of_noise(const Noise& noise);

// Why a method does not keep its law with the linear solver of this system, which stops at a tolerance; "" where what
// that misses is restored, and where there is no such solver.
std::string objection_of_solver(const System& system, const MethodEntry& method);

}  // namespace seiche
