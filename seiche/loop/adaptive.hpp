// The time loop with variable steps.
#pragma once

#include <seiche/core/observer.hpp>
#include <seiche/core/system.hpp>
#include <seiche/loop/integrate.hpp>

#include <functional>
#include <span>
#include <string>

namespace seiche {

struct AdaptiveOptions {
  double tolerance = 0.0;  // of values at the end, in the max norm; > 0
  double t_end = 0.0;
  double first_h = 0.0;    // 0: chosen from the first derivative
  double largest_h = 0.0;  // 0: no bound. What happens and ends inside one step, as a pulse of γ(t), no estimate sees
  LawPromise law = {};
  std::function<std::string()> objection = {};
  std::function<std::string()> explanation = {};
  const std::atomic<bool>* stop = nullptr;
  std::span<const Event> events = {};
  Resumption resumption = {};
};

// As `integrate`, with steps whose errors fit the tolerance. Times that observers ask for do not shorten steps. Throws
// Error for a tolerance or times that make no sense; never for numerical reasons.
RunReport integrate_adaptive(const System& system, AdaptiveStepper& stepper, State& state,
                             const AdaptiveOptions& options, std::span<Observer* const> observers = {});

// Steps of variable size by `adaptive`; or, where that is null, of the one size options.first_h by `stepper`: what
// belongs to a tolerance is then not looked at.
RunReport integrate_either(const System& system, Stepper& stepper, AdaptiveStepper* adaptive, State& state,
                           const AdaptiveOptions& options, std::span<Observer* const> observers = {});

}  // namespace seiche
