// Space, potential and damping of a system on a grid, in whichever coordinates a FieldTransform gives each field.
#pragma once

#include <seiche/backend/linear_map.hpp>
#include <seiche/backend/transform.hpp>
#include <seiche/core/damping.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/core/problem.hpp>
#include <seiche/core/space.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace seiche {

class GridSpace final : public Space {
 public:
  GridSpace(Index fields, std::shared_ptr<const FieldTransform> transform);
  Index size() const override { return fields_ * transform_->slots(); }
  Index physical_size() const override { return fields_ * transform_->unknowns(); }
  void to_physical(const Vector& z, Vector& values) const override;
  void from_physical(const Vector& values, Vector& z) const override;

 private:
  Index fields_;
  std::shared_ptr<const FieldTransform> transform_;
};

// V of one field: inverse transform, pointwise, forward transform. A problem without potential has V = 0.
class GridPotential final : public Potential {
 public:
  GridPotential(const Problem& problem, std::shared_ptr<const FieldTransform> transform);
  double value(const Vector& z) const override;
  double magnitude(const Vector& z) const override;
  double value_and_gradient(const Vector& z, Vector& gradient) const override;
  void mean_gradient(const Vector& a, const Vector& b, Vector& mean) const override;
  int degree() const override { return pointwise_ ? pointwise_->degree() : 1; }
  void along(const Vector& p, const Vector& q, std::span<double> coefficients) const override;
  Support support() const override { return support_; }

 private:
  std::span<const double> values_of(const Vector& z, Vector& values) const;
  void set_gradient(const Vector& physical, Vector& gradient) const;

  std::shared_ptr<const PointwisePotential> pointwise_;
  std::shared_ptr<const FieldTransform> transform_;
  Support support_;
  mutable Vector a_, b_, slope_;  // scratch, one field on its grid
};

// D(t) = constant + γ(t)P; the parts of the problems here commute, so Ψ is the product of their flows.
class GridDamping final : public Damping {
 public:
  using MakeFlow = std::function<std::unique_ptr<LinearMap>(double h)>;  // e^{−h constant}
  GridDamping(const Problem& problem, Index slots, std::unique_ptr<LinearMap> constant, MakeFlow make_flow);
  bool is_zero() const override { return !constant_ && !rate_; }
  bool touches_potential() const override { return touches_potential_; }
  void flow(double t, double h, Vector& z) const override;
  void apply(double t, const Vector& z, Vector& out) const override;

 private:
  const LinearMap& flow_map(double h) const;

  struct CachedFlow {
    double h;
    std::unique_ptr<LinearMap> map;
  };
  Index slots_;
  std::unique_ptr<LinearMap> constant_;  // null: none
  MakeFlow make_flow_;
  RatePointer rate_;
  std::vector<bool> rate_fields_;
  bool touches_potential_;
  mutable std::vector<CachedFlow> flows_;  // most recently used first
  mutable Vector scratch_;
};

}  // namespace seiche
