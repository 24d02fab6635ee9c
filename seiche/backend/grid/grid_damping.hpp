// The damping of a system on a grid, in whichever coordinates a FieldTransform gives each field.
#pragma once

#include <seiche/backend/fft/transform.hpp>
#include <seiche/backend/grid/field_decay.hpp>
#include <seiche/core/damping.hpp>
#include <seiche/core/numerics/linear_map.hpp>
#include <seiche/core/problem.hpp>
#include <seiche/core/step_cache.hpp>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace seiche {

// D(t) = constant + (γ(t) + γ(x, t))P. Where the constant part and γ(t)P commute (rate_commutes) Ψ is the product of
// their flows. Elsewhere, and for γ(x, t)P, which commutes with γ(t)P only, the flow of the rates stands between two
// halves of the constant one: symmetric and of order two, and each factor keeps the law.
class GridDamping final : public Damping {
 public:
  using MakeFlow = std::function<std::unique_ptr<LinearMap>(double h)>;  // e^{−h constant}
  GridDamping(const Problem& problem, std::shared_ptr<const FieldTransform> transform,
              std::unique_ptr<LinearMap> constant, MakeFlow make_flow);
  // Where coordinates are the physical values, so many of each field.
  GridDamping(const Problem& problem, Index unknowns, std::unique_ptr<LinearMap> constant, MakeFlow make_flow)
      : GridDamping(problem, identity_transform(unknowns), std::move(constant), std::move(make_flow)) {}
  bool is_zero() const override { return !constant_ && !rate_ && !field_rate_; }
  bool touches_potential() const override { return touches_potential_; }
  void flow(double t, double h, Vector& z) const override;
  void apply(double t, const Vector& z, Vector& out) const override;
  std::optional<double> factor_of_identity(double t) const override;
  bool is_constant() const override { return !field_rate_ && (!rate_ || rate_->is_constant()); }
  void apply_rest(double t, const Vector& z, Vector& out) const override;
  void apply_D0(const Vector& z, Vector& out) const override;
  void add_quadrature_error(const Space& space, double t, double h, std::span<const double> c,
                            std::span<const double> w, const Vector& before, const Vector& after,
                            Vector& out) const override;
  double largest_rate(const Space& space, double t, double h, const Vector& before, const Vector& after) const override;
  bool field_factors(double t, double h, std::span<double> factors) const override;

 private:
  double integral_error_at_ends(double t, double h) const;  // of ∫γ, where γ jumps there; in units of h
  void apply_constant(const Vector& z, Vector& out) const;
  void constant_flow(double h, Vector& z) const;
  void rates_flow(double t, double h, Vector& z) const;
  double rate_decay(double t, double h) const;                // e^{−∫γ}
  double largest_factor(const Space& space, double t) const;  // |γ(t)| + max |γ(x, t)|
  // out += (γ + γ_j)P z, with γ_j of every point; null: none
  void add_rates(double gamma, const Vector* at_points, const Vector& z, Vector& out) const;

  Index slots_;
  std::unique_ptr<LinearMap> constant_;  // null: none
  MakeFlow make_flow_;
  RatePointer rate_;
  double rate_of_D0_;
  std::unique_ptr<FieldDecay> field_rate_;  // null: none
  std::vector<bool> rate_fields_;
  bool touches_potential_;
  bool rates_commute_;                  // with the constant part
  mutable StepCache<LinearMap> flows_;  // of the constant part
  struct {
    double h = 0.0, decay = 1.0;
  } mutable decay_of_;                              // of a constant rate: the last length asked for
  mutable std::optional<double> rate_of_constant_;  // of the constant part, or of all where nothing varies
  mutable Vector scratch_;
  mutable Vector missed_;  // at the points
};

}  // namespace seiche
