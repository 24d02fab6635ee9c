// The damping of a system on a grid, in whichever coordinates a FieldTransform gives each field.
#pragma once

#include <seiche/backend/linear_map.hpp>
#include <seiche/core/damping.hpp>
#include <seiche/core/problem.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace seiche {

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
