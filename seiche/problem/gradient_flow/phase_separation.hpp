// Two phases that part: the Allen–Cahn and the Cahn–Hilliard equation in one to three dimensions, gradient flows of
// H = Σ ½κ|∇u|² + ρ(u − a)²(u − b)².
#pragma once

#include <seiche/problem/common/grid_options.hpp>
#include <seiche/problem/common/problem_entry.hpp>

namespace seiche {

struct PhaseSeparation {
  enum class Initial { waves, drop };

  GridOptions grid = {.points = {128}, .length = {1.0}, .discretisation = Discretisation::spectral};
  double kappa = 1e-3;                           // κ > 0, gradient energy; an interface is √(2κ/ρ)/|b − a| wide
  double mobility = 1.0;                         // m > 0, where it is a number
  StateFunctionPointer mobility_of_u = nullptr;  // M(u) ≥ 0 in its place, or null
  double barrier = 0.25;                         // ρ > 0; ¼ with a = −1, b = 1 is ¼(u² − 1)²
  double low = -1.0;                             // a
  double high = 1.0;                             // b
  // β ≥ 0: ½βu² stands in M and not in V. H is the same, and the step in which V is taken explicitly may be longer:
  // with the curvature of the wells, 2ρ(b − a)², V does not pull where a phase is at rest.
  double stabilisation = 0.0;
  double mean = 0.0;                 // of the waves
  double amplitude = 0.5;            // of the waves
  Initial initial = Initial::waves;  // or a drop of the phase b in the phase a, of radius a quarter of the first axis
};

// u_t = m(κΔu − W′(u)): S = −m, or −M(u). Throws Error where a number is out of its bounds.
Problem allen_cahn(const PhaseSeparation& options = {});
// u_t = mΔ(W′(u) − κΔu): S = mΔ, or ∇·M(u)∇ (varying_mobility.hpp); the mean of u stays where no end is held at zero.
Problem cahn_hilliard(const PhaseSeparation& options = {});

ProblemEntry allen_cahn_entry();
ProblemEntry cahn_hilliard_entry();

}  // namespace seiche
