// The time loop.
#pragma once

#include <seiche/core/observer.hpp>
#include <seiche/core/system.hpp>
#include <seiche/loop/checkpoints.hpp>

#include <atomic>
#include <functional>
#include <span>
#include <string>

namespace seiche {

// g(t, z) changes sign at an event; z in the coordinates of the state.
struct Event {
  enum class Direction { any, rising, falling };
  std::function<double(double t, const Vector& z)> g;
  // What happens: may change the state, which the method then starts from anew. False ends the run. Null: the run ends.
  std::function<bool(State& state)> action = {};
  Direction direction = Direction::any;
};

struct IntegrateOptions {
  double h = 0.0;
  double t_end = 0.0;
  LawPromise law = {};
  // Asked when the run ends: why the promise is withdrawn after all, or "".
  std::function<std::string()> objection = {};
  std::function<std::string()> explanation = {};  // of a step that failed, from the state then; "" if none
  const std::atomic<bool>* stop = nullptr;        // set by a signal handler: the run ends after the current step
  // Located by shorter steps from the left end of the step they lie in; behind one, steps of length h go on from its
  // time.
  std::span<const Event> events = {};
  Resumption resumption = {};
};

// Steps from state.t to t_end, or from where options.resumption leaves off; state must have been begun. t = t₀ + n h;
// the last step is shortened to land on t_end.
// A failed step ends the run with what was computed before it; an energy above the promised law (beyond round-off,
// judged at every step that some observer records) sets law = violated. Never throws for numerical reasons.
RunReport integrate(const System& system, Stepper& stepper, State& state, const IntegrateOptions& options,
                    std::span<Observer* const> observers = {});

}  // namespace seiche
