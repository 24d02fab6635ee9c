// ∇V where a step ends, which the next step begins with.
#pragma once

#include <seiche/core/state.hpp>
#include <seiche/core/system.hpp>

namespace seiche {

// Of splittings that look at V where they end: a step then costs no gradient at its start, and V at its end is known.
class EndGradient {
 public:
  explicit EndGradient(const System& system);  // which outlives it

  void begin(State& s) const;              // makes room in s.history, where nothing is known yet
  const Vector& at_start(const State& s);  // ∇V(s.z), zero outside the support of V; taken anew where it is not known
  const Vector& take(const Vector& z);     // ∇V(z)
  const Vector& last() const { return gradient_; }  // of the last `take`
  const double& V() const { return V_; }            // there

  // The step that looked last at ẑ is taken, from s to factor · ẑ; 0: to another state.
  void accept(State& s, double h, double factor);

 private:
  const System& system_;
  Vector start_, gradient_;
  double V_ = 0;
};

}  // namespace seiche
