// What watches a run. The library is silent; observers record and print.
#pragma once

#include <seiche/core/run_report.hpp>
#include <seiche/core/state.hpp>
#include <seiche/core/stepper.hpp>

#include <cstdint>
#include <limits>

namespace seiche {

// Due at step 0, at every `every_steps`-th step (never in between if 0) and at the last one.
struct Schedule {
  std::int64_t every_steps = 1;
  bool is_due(std::int64_t n, bool last) const { return n == 0 || last || (every_steps > 0 && n % every_steps == 0); }
};

class Observer {
 public:
  virtual ~Observer() = default;
  virtual bool is_due(const State& state, bool last) const = 0;
  // `energy` was read at this state. Called for the initial state, after due steps, and for the last good state.
  virtual void observe(const State& state, const EnergyReading& energy) = 0;
  // In the place of `observe` where one before it has failed: takes part in what processes do there together.
  virtual void skip(const State&) {}
  // After every step for which it is not due: for what has to happen by the clock.
  virtual void pass(const State&) {}
  // The next time at which it wants to be shown the solution wherever steps end, or infinity. Runs with variable steps
  // only.
  virtual double next_time() const { return std::numeric_limits<double>::infinity(); }
  // Once, however the run ended: make what was recorded whole on disk.
  virtual void finish(const RunReport& report) = 0;
};

}  // namespace seiche
