// V(Pz) in modal coordinates, where the projection P multiplies each by 0 or 1.
#pragma once

#include <seiche/core/potential.hpp>

#include <memory>

namespace seiche {

class MaskedPotential final : public Potential {
 public:
  // `mask` has one number for each component of the support of `potential`.
  MaskedPotential(std::unique_ptr<Potential> potential, Vector mask);
  double value(const Vector& z) const override;
  double magnitude(const Vector& z) const override;
  ValueAndMagnitude value_and_magnitude(const Vector& z) const override;
  double value_and_gradient(const Vector& z, Vector& gradient) const override;
  void mean_gradient(const Vector& a, const Vector& b, Vector& mean) const override;
  void gradient_round_off(const Vector& z, Vector& bounds) const override;
  int degree() const override { return potential_->degree(); }
  int homogeneity() const override { return potential_->homogeneity(); }
  void along(const Vector& p, const Vector& q, std::span<double> coefficients) const override;
  void along_ray(const Vector& z, std::span<double> coefficients) const override;
  Support support() const override { return potential_->support(); }

 private:
  const Vector& masked(const Vector& z, Vector& out) const;
  void mask(Vector& gradient) const;

  std::unique_ptr<Potential> potential_;
  Vector mask_;
  mutable Vector a_, b_;  // states; V reads no more of them than its support
};

}  // namespace seiche
