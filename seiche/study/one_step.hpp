// One step of a method on the linear part of a problem, as a map of physical values.
#pragma once

#include <seiche/simulation/simulation.hpp>

#include <atomic>

namespace seiche {

// V = 0, and every rate at t = 0 for good.
Problem linear_part_of(const Problem& problem);

class OneStep {
 public:
  OneStep(const Problem& linear, const SimulationOptions& options, double h, const std::atomic<bool>* stop = nullptr)
      : simulation_(linear, options), h_(h), stop_(stop) {}
  // z⁺, from t = 0. Throws std::runtime_error, with the method's sentence, where the step fails, and Error where it is
  // to stop.
  Vector operator()(const Vector& z);
  Vector derivative(const Vector& z) const;  // SMz − D(0)z
  void go_on() const;                        // throws Error where it is to stop
  const Simulation& simulation() const { return simulation_; }

 private:
  Simulation simulation_;
  double h_;
  const std::atomic<bool>* stop_;
};

struct Linearity {
  bool is_homogeneous = true;  // the step of 2z is twice that of z
  bool is_linear = true;       // and that of y + z the sum of theirs
};
// Seen on two states with all modes in them.
Linearity linearity_of(OneStep& step, const Vector& y, const Vector& z);

}  // namespace seiche
