// Operators that multiply every mode of a grid by a function of its wave vector: dispersion relations as they are
// written down.
#pragma once

#include <seiche/core/grid/grid.hpp>
#include <seiche/core/grid/modes.hpp>

#include <Eigen/Dense>

#include <array>
#include <complex>
#include <functional>

namespace seiche {

// (κ_x, κ_y, κ_z) in radians per unit of length; 0 along axes that are not there.
using WaveVector = std::array<double, 3>;
using WaveFunction = std::function<double(const WaveVector&)>;

// The operator is real, so its symbol on −κ is the conjugate of that on κ.
enum class Parity {
  even,  // the symbol is f(κ), and f(−κ) = f(κ)
  odd    // the symbol is i f(κ), and f(−κ) = −f(κ)
};

class FourierMultiplier {
 public:
  // Where f is not finite at κ = 0 and even, its limit there is taken, which must be the same from every side (axes,
  // diagonals and some directions between them are looked at). On modes of the
  // highest wave number that a grid tells apart, ±κ_a are one mode: f is its mean over both. Throws Error with the wave
  // vector where f is not finite or not of this parity; an axis with ends needs f(…, −κ_a, …) = f(…, κ_a, …), and odd
  // symbols none.
  FourierMultiplier(const Grid& grid, WaveFunction f, Parity parity);

  Parity parity() const { return parity_; }
  std::complex<double> symbol(const Mode& mode) const;
  Eigen::MatrixXd matrix(const Grid& grid) const;  // grid: that of the constructor

 private:
  WaveVector wave_vector(const Mode& mode) const;
  double value(const Mode& mode) const;
  double limit_at_zero(const Grid& grid) const;
  void require_parity(const Grid& grid, const WaveVector& kappa) const;
  Eigen::VectorXcd symbols_in_full(const Grid& grid) const;

  WaveFunction f_;
  Parity parity_;
  std::array<double, 3> dx_{1, 1, 1};
  std::array<bool, 3> periodic_{};
  double at_zero_ = 0;
};

}  // namespace seiche
