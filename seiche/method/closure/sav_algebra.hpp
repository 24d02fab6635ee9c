// The algebra of a SAV substep: what becomes of r² and C, and what factor ĝ gets (paper (3.1b), (3.3), (3.5)). The same
// functions serve single runs and ensembles; they have no branches, so that a loop over members becomes vector code.
#pragma once

#include <seiche/core/base/vector.hpp>
#include <seiche/core/propagator.hpp>

#include <cmath>

namespace seiche {

struct SavAuxiliary {
  double r_squared, shift;  // r², C
  double energy_scale;      // |½z₀ᵀMz₀| + |V(z₀)|
};

namespace sav_algebra {

[[gnu::always_inline]] inline double larger(double a, double b) { return a > b ? a : b; }
[[gnu::always_inline]] inline double smaller(double a, double b) { return a < b ? a : b; }

// By how much C and r² rise together, which leaves H̃ as it is: where V + C or r² has become small against the energy,
// or against `against_drift`, the V + C at which the drift of r² does no harm. A large positive V(ẑ) is no reason to:
// at steps far too long ẑ is meaningless, and with a C to match it H̃ would lose its digits to round-off.
[[gnu::always_inline]] inline double rise(const SavAuxiliary& a, double v_mid, double quadratic_energy,
                                          double against_drift) {
  constexpr double tiny = 1e-300;
  constexpr double least = 0.1;  // of the energy
  constexpr double most = 1e8;   // of C for the energy: H̃ keeps half its digits
  constexpr double seldom = 4;   // more than is needed now, so that C rises in few steps
  const double scale = larger(larger(quadratic_energy + larger(0, -v_mid), a.energy_scale), tiny);
  const double margin = smaller(a.r_squared, v_mid + a.shift);
  const double against = smaller(against_drift, most * scale);
  const double wanted = larger(2 * scale, seldom * against) - margin;
  return margin < larger(least * scale, against) ? wanted : 0.0;
}

struct Force {
  double factor;     // of Fĝ: r̄/√(V(ẑ) + C); not a number where V(ẑ) + C ≤ 0
  double r_squared;  // (r⁺)²
};

// r̄ = ½(r⁺ + r⁻) from r⁺ − r⁻ = ½gᵀ(z⁺ − z⁻) with z⁺ − z⁻ = FMz⁻ + r̄Fg:   r̄ = (r⁻ + ¼gᵀFMz⁻) / (1 − ¼gᵀFg)
[[gnu::always_inline]] inline Force force(const SavAuxiliary& a, double v_mid, double of_increment, double of_force) {
  const double to_g = 1 / std::sqrt(v_mid + a.shift);  // g = ĝ/√(V(ẑ) + C)
  const double gd = to_g * of_increment;               // gᵀFMz⁻
  const double gq = to_g * to_g * of_force;            // gᵀFg ≤ 0
  const double r = std::sqrt(a.r_squared);
  const double r_mid = (r + gd / 4) / (1 - gq / 4);  // r̄
  return {r_mid * to_g, square(2 * r_mid - r)};      // r⁺ = 2r̄ − r⁻                        (3.1b), (4.2)
}

}  // namespace sav_algebra
}  // namespace seiche
