// A force f(x, t) from outside, in the coordinates of State::z.
#pragma once

#include <seiche/core/base/vector.hpp>

namespace seiche {

class ExternalForce {
 public:
  virtual ~ExternalForce() = default;
  virtual void add(double t, double factor, Vector& out) const = 0;  // out += factor · f(t)
  virtual void impulse(double t, double h, Vector& z) const = 0;     // z += ∫ₜᵗ⁺ʰ f
  virtual bool touches_potential() const = 0;                        // true if it moves a component that V depends on
};

}  // namespace seiche
