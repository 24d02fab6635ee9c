// Duffing's oscillator, q̈ + γq̇ + ω²q + αq³ = 0: one, or several that do not touch.
#pragma once

#include <seiche/problem/problems.hpp>

namespace seiche {

struct Oscillator {
  Index points = 1;            // number of oscillators
  double omega_squared = 1.0;  // if negative it is moved into V, so that M ⪰ 0: a double well
  double alpha = 1.0;
  DampingRate gamma = nullptr;  // 1/time; null: undamped
};

// z = (q_1 …, p_1 …), H = Σ ½p² + ½ω²q² + α/4 q⁴; released at rest from q = 1 (the first), 1/2 (the second), 1/3 ….
Problem oscillator(const Oscillator& options = {});

ProblemEntry oscillator_entry();

}  // namespace seiche
