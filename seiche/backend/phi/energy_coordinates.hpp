// Coordinates in which ½zᴴMz is half a sum of squares, and fast and slow motion have entries of one size.
#pragma once

#include <seiche/core/base/vector.hpp>

#include <Eigen/Core>

#include <optional>

namespace seiche {

// z = Ty with TᴴMT = diag(I, 0): the first `rank` of y carry the energy, the others are motion along the kernel of M.
// In z, a fast oscillation is a small displacement beside large momenta and the errors of a product reach ε(hω)²; in y
// they reach εhω, as much as the rounding of M itself. Of real or complex matrices.
template <class Matrix>
struct EnergyCoordinates {
  Matrix T, inverse;
  Index rank = 0;

  // With S' = T⁻¹ST⁻ᴴ, ẏ = S' diag(I, 0) y is ż = SMz. Skew where S is, to the bit.
  Matrix structure(const Matrix& S) const;
  // −(S' + S'ᴴ), free of the round-off of S' where its skew part is large.
  Matrix loss(const Matrix& S) const;
  // diag(I, 0)
  Matrix metric() const;
  // Turns lengths along the kernel into multiples of `unit`.
  void scale_kernel(double unit);
};

// Nothing where M is not positive semidefinite or not finite.
template <class Matrix>
std::optional<EnergyCoordinates<Matrix>> energy_coordinates(const Matrix& M);

// Units along the kernel of M for a step h: what energy moves along it, or ∇V there, is then of the size of the energy.
// One where S and the kernel have only round-off in common, as where the kernel is one of S too.
template <class Matrix>
double kernel_unit(const EnergyCoordinates<Matrix>& c, const Matrix& S, double h);

}  // namespace seiche
