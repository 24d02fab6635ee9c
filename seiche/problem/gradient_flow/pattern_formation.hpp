// Patterns of one wavelength: the Swift–Hohenberg and the phase-field crystal equation in one to three dimensions,
// gradient flows of H = Σ ½((q² + Δ)u)² − ½ru² − ⅓gu³ + ¼u⁴.
#pragma once

#include <seiche/problem/common/grid_options.hpp>
#include <seiche/problem/common/problem_entry.hpp>

namespace seiche {

struct PatternFormation {
  enum class Initial { waves, seed };

  GridOptions grid = {.points = {128}, .length = {64.0}, .discretisation = Discretisation::spectral};
  double r = 0.3;                    // drives the pattern, where it is positive
  double g = 0.0;                    // of the cubic term of H
  double q = 1.0;                    // wave number of the pattern
  double mobility = 1.0;             // m > 0
  double mean = 0.0;                 // of the initial data
  double amplitude = 0.1;            // of the initial data
  Initial initial = Initial::waves;  // or a Gaussian seed of half a wavelength in the centre
};

// u_t = m(ru − (q² + Δ)²u + gu² − u³): S = −m. Throws Error where the mobility is not > 0.
Problem swift_hohenberg(const PatternFormation& options = {});
// u_t = mΔ((q² + Δ)²u − ru − gu² + u³): S = mΔ; the mean of u stays where no end is held at zero.
Problem phase_field_crystal(const PatternFormation& options = {});

ProblemEntry swift_hohenberg_entry();
ProblemEntry phase_field_crystal_entry();

}  // namespace seiche
