// The potential of a system on a grid, in whichever coordinates a FieldTransform gives each field.
#pragma once

#include <seiche/backend/fft/transform.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/core/space.hpp>

#include <array>
#include <memory>
#include <vector>

namespace seiche {

// V of one or several fields: inverse transform, pointwise, forward transform. A problem without potential has V = 0.
class GridPotential final : public Potential {
 public:
  // V of the fields from `first_field` on; null: V = 0. `space` outlives it, and adds up what each process knows.
  GridPotential(std::shared_ptr<const PointwisePotential> pointwise, Index first_field,
                std::shared_ptr<const FieldTransform> transform, const Space& space);
  double value(const Vector& z) const override;
  double magnitude(const Vector& z) const override;
  ValueAndMagnitude value_and_magnitude(const Vector& z) const override;
  double value_and_gradient(const Vector& z, Vector& gradient) const override;
  void mean_gradient(const Vector& a, const Vector& b, Vector& mean) const override;
  void gradient_round_off(const Vector& z, Vector& bounds) const override;
  int degree() const override { return pointwise_ ? pointwise_->degree() : 1; }
  void along(const Vector& p, const Vector& q, std::span<double> coefficients) const override;
  void along_ray(const Vector& z, std::span<double> coefficients) const override;
  int homogeneity() const override { return pointwise_ ? pointwise_->homogeneity() : 0; }
  Support support() const override { return support_; }

 private:
  std::span<const double> values_of(const Vector& z, Vector& values) const;
  template <class OfPart>
  void add(const OfPart& of_part, std::span<double> totals) const;
  std::span<double> gathered(std::span<const double> u, Index unit, Vector& block) const;
  using Number = double (PointwisePotential::*)(std::span<const double> u) const;
  double total(std::span<const double> u, Number number) const;
  double value_and_slopes_by_units() const;
  void set_gradient(const Vector& physical, Vector& gradient) const;

  std::shared_ptr<const PointwisePotential> pointwise_;
  std::shared_ptr<const FieldTransform> transform_;
  const Space& space_;
  Support support_;
  bool takes_values_as_they_are_ = false;  // at once: coordinates are values, in one unit
  // Where V is a sum over points of several fields, or of the place: V of the points of each unit, which are gathered.
  bool is_gathered_ = false;
  std::vector<std::shared_ptr<const PointwisePotential>> of_units_;
  mutable Vector a_, b_, slope_;          // scratch, V's fields on their grid
  mutable std::array<Vector, 2> blocks_;  // the same of one unit
};

}  // namespace seiche
