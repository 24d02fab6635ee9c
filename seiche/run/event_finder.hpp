// Where an event function changes its sign inside a step.
#pragma once

#include <seiche/core/stepper.hpp>
#include <seiche/run/adaptive.hpp>

#include <span>
#include <vector>

namespace seiche {

class EventFinder {
 public:
  explicit EventFinder(std::span<const Event> events) : events_(events), values_(events.size()) {}

  void start(const State& state);  // the values from which signs change

  struct Found {
    const Event* event = nullptr;  // null: none
    double t = 0.0;
  };
  // The first event inside the last step, located on the solution inside it to round-off in t by bisection and secants
  // (TOMS 748). Afterwards the values are those at the end of the step.
  Found find(const State& state, AdaptiveStepper& stepper);

 private:
  std::span<const Event> events_;
  std::vector<double> values_;
  double t_ = 0.0;
  Vector z_;
};

}  // namespace seiche
