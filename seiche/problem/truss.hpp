// Vibrations of a plane truss: masses joined by elastic bars and dashpots, small rotations, nonlinear springs.
#pragma once

#include <seiche/problem/problems.hpp>

namespace seiche {

// A Pratt truss: `panels` squares of side `side` between two supports that do not move, verticals, and one diagonal per
// panel that falls towards the middle. Nodes that move are numbered along the lower chord, then along the upper one.
struct Truss {
  Index panels = 6;
  double side = 1.0;
  double mass = 1.0;         // of every node
  double stiffness = 100.0;  // EA: a bar of length ℓ has the spring constant EA/ℓ
  double cubic = 0.0;        // W(e) = cubic/3 e³ + quartic/4 e⁴ per bar, besides the linear spring
  double quartic = 200.0;
  double dashpot = 0.2;         // force per rate of elongation
  RatePointer gamma = nullptr;  // drag of the air, 1/time
  double amplitude = 0.1;       // of the initial deflection, half a sine
};

// z = (x, y, px, py). With e = n·(u_b − u_a) for each bar: H = ½Σ|p|²/m + ½Σ(EA/ℓ)e² + ΣW(e), ṗ = −∂H/∂q − Σ c n nᵀ(v_b
// − v_a).
Problem truss(const Truss& options = {});

ProblemEntry truss_entry();

}  // namespace seiche
