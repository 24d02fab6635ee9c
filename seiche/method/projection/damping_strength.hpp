// How fast damping acts in one step, by D, by R and by the symmetric part of S.
#pragma once

#include <seiche/core/system.hpp>

namespace seiche {

class DampingStrength {
 public:
  explicit DampingStrength(const System& system) : system_(system) {}  // which outlives it

  // The largest rate, in 1/time, in a step h from `before` to `after`: Damping::largest_rate, and the larger one of
  // sym(S)∇H at both states. The first call may allocate.
  double largest(double t, double h, const Vector& before, const Vector& after);

 private:
  double of_S(double h, const Vector& z);
  void take_flow(const Vector& z, Vector& flow);  // sym(S)∇H; both may be one

  const System& system_;
  bool S_is_skew_ = false;  // as far as is known
  Vector gradient_, slope_, flow_, moved_;
};

}  // namespace seiche
