// Coefficients of Runge–Kutta–Nyström splittings.
#pragma once

#include <cstddef>
#include <vector>

namespace seiche {

// B(b₀h) A(a₀h) B(b₁h) … A(a_{m−1}h) B(b_mh), read from both ends alike, for flows A of a linear equation and B of a
// kick that positions alone decide: then [B, [B, [B, A]]] = 0, whatever damping is in A, and fewer conditions remain.
// Some a and b are negative.
struct NystromScheme {
  std::vector<double> a, b;

  std::size_t flows() const { return a.size(); }
  std::size_t distinct_flows() const { return (a.size() + 1) / 2; }  // equal flows share their tables
  std::size_t which(std::size_t flow) const { return flow < distinct_flows() ? flow : a.size() - 1 - flow; }
};

// SRKN₆ᵇ of order 4 and SRKN₁₁ᵇ of order 6: S. Blanes and P. C. Moan, J. Comput. Appl. Math. 142 (2002). Throws Error
// for any other order.
const NystromScheme& nystrom_scheme(int order);

// The largest x = hω up to which an oscillator of frequency ω, its force in the kicks, stays bounded: before it there
// are resonances narrower than a hundredth, whose growth no run will see.
double stability_of_kicks(const NystromScheme& scheme);

}  // namespace seiche
