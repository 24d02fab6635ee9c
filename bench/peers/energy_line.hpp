// H of an equation along a straight line, and its rate: what integrators by relaxation ask for.
#pragma once

#include <bench/peers/equation.hpp>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace seiche::bench {

// Not of gradient flows. H = ½|v|² − ½κuᵀRu + ½m²|u|² + α/4 Σu⁴ and so on, sums over the points.
class EnergyLine {
 public:
  explicit EnergyLine(const Equation& equation);

  using Coefficients = std::array<double, 4>;
  // H(z + γd) − H(z) = γ(c₀ + c₁γ + c₂γ² + c₃γ³), without the cancellation of the left side
  Coefficients along(const double* z, const double* d);
  double rate(const double* z);  // dH/dt of the equation at z

 private:
  const Equation equation_;
  std::vector<double> laplacian_;
};

// The root near 1 of a function, by Newton's method. f(x): value and slope.
template <class F>
double root_near_one(const F& f) {
  double x = 1;
  for (int i = 0; i < 20; ++i) {
    const std::pair<double, double> here = f(x);
    const double change = here.first / here.second;
    x -= change;
    if (!(std::abs(change) > 1e-15)) break;
  }
  return x;
}

}  // namespace seiche::bench
