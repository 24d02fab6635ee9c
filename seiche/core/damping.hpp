// The damping D(t)z + R(t, z) and its flow; R = 0 but for friction beyond linear.
#pragma once

#include <seiche/core/space.hpp>

#include <cstdint>
#include <optional>
#include <span>

namespace seiche {

class Damping {
 public:
  virtual ~Damping() = default;
  virtual bool is_zero() const = 0;
  virtual bool touches_potential() const = 0;      // true if it moves a component that V depends on
  virtual bool is_linear() const { return true; }  // R = 0
  // z ← Ψ(t, t+h) z: exp(−∫ₜᵗ⁺ʰ D) z, or with R a symmetric composition of its flow and that one. The length h is
  // passed instead of the end so that equal steps reuse one matrix.
  virtual void flow(double t, double h, Vector& z) const = 0;
  virtual void apply(double t, const Vector& z, Vector& out) const = 0;  // D(t)z + R(t, z)
  // γ(t) where D(t)z + R(t, z) = γ(t)z for every z, and nothing where damping is no multiple of the state.
  virtual std::optional<double> factor_of_identity(double /*t*/) const { return std::nullopt; }
  // True if D(t)z + R(t, z) = D₀z, the constant part that exponential methods take into L = SM − D₀ (constant_damping).
  virtual bool is_constant() const = 0;
  virtual void apply_rest(double t, const Vector& z, Vector& out) const = 0;  // (D(t) − D₀)z + R(t, z)
  virtual void apply_D0(const Vector& z, Vector& out) const = 0;              // D₀z
  // out += ∫ₜᵗ⁺ʰ f(s) ds − h Σ wᵢf(t + cᵢh): what a quadrature with these nodes and weights does not see of a step
  // between two states. Of the linear part, f(s) = D(s)z with z behind the step, and what its integral does not see of
  // jumps at the ends (EndExtrapolation); of friction, f(s) = R on the straight line between the states, where layers
  // at v = 0 are seen. The first call may allocate.
  virtual void add_quadrature_error(const Space& /*space*/, double /*t*/, double /*h*/, std::span<const double> /*c*/,
                                    std::span<const double> /*w*/, const Vector& /*before*/, const Vector& /*after*/,
                                    Vector& /*out*/) const {}
  // The largest rate, in 1/time, at which D(t) + ∂R/∂z acts in a step h from `before` to `after`: of what varies in
  // time, at the ends and in the middle; of R, at both states, and at rest where a velocity changes its sign. The first
  // call may allocate.
  virtual double largest_rate(const Space& space, double t, double h, const Vector& before,
                              const Vector& after) const = 0;
  virtual std::int64_t corrections() const { return 0; }  // Friction::corrections
  // Where Ψ(t, t+h) multiplies each field by a number: those numbers, and true. A step then need not make a pass of it.
  virtual bool field_factors(double /*t*/, double /*h*/, std::span<double> /*factors*/) const { return false; }
};

}  // namespace seiche
