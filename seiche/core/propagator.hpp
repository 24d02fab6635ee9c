// The linear substep z⁺ = Ez + Ff for one step size h.
#pragma once

#include <seiche/core/base/vector.hpp>
#include <seiche/core/step_cache.hpp>

#include <memory>
#include <span>

namespace seiche {

enum class PropagatorKind { exponential, cayley };

// Contract, for A = hSM:  E = I + FM  and  F + Fᵀ + FᵀMF = 0 if S is skew, ⪯ 0 if sym(S) ⪯ 0.
// Every energy law of method/ follows from it alone; to what it holds, the law holds.
//   exponential: E = e^A,                F = hφ₁(A)S
//   cayley:      E = (I−A/2)⁻¹(I+A/2),   F = h(I−A/2)⁻¹S
class Propagator {
 public:
  virtual ~Propagator() = default;
  virtual void increment(const Vector& z, Vector& dz) const = 0;  // FMz = (E − I)z
  virtual void force(const Vector& f, Vector& q) const = 0;       // Ff

  // What an explicit closure asks for, in as few passes over z as the coordinates allow. Forces and gradients vanish
  // outside the components that V depends on. z stands for z⁻ = Λz, with Λ one number per field: a damping half-flow
  // carried out on the way. Empty: Λ = I.
  using FieldFactors = std::span<const double>;

  // ẑ, a second-order approximation at the midpoint, from z⁻ and ∇V(z⁻): the components that V depends on, and no
  // others are written. z_mid may be the gradient.
  virtual void predict(const Vector& z, const Vector& gradient, Vector& z_mid, FieldFactors before = {}) const = 0;

  // The same from gradients at the last three midpoints, for ḡ = g₀ + weight·(g₀ − g₁) in the place of ∇V(z⁻). `missed`
  // is what such an extrapolation missed last time, F_{h/2} applied to g₀ − g₁ − ratio·(g₁ − g₂), and `moved` is
  // ẑ − z⁻: squares of Euclidean norms of coordinates on the support. False, and nothing done, where it is not fused.
  struct Recalled {
    double missed = 0.0, moved = 0.0;
    bool missed_is_rough = false;  // a bound, or an estimate where one product more would tell
  };
  struct Gradients {
    const Vector &g0, &g1, &g2;
    double weight, ratio;
  };
  virtual bool recall(const Vector& /*z*/, const Gradients&, Vector& /*z_mid*/, FieldFactors /*before*/,
                      Recalled&) const {
    return false;
  }

  struct Powers {
    double of_increment = 0.0;      // fᵀFMz⁻
    double of_force = 0.0;          // fᵀFf
    double quadratic_energy = 0.0;  // ½z⁻ᵀMz⁻
  };
  // Behind `predict` or `recall`. Where the propagator fuses `recall`, the last of these was of the same z and Λ, and
  // its z⁻ may be used again.
  virtual Powers powers(const Vector& z, const Vector& f, FieldFactors before = {}) const = 0;

  // z ← Λ'(z⁻ + FMz⁻ + c Ff), with Λ' the half-flow after the substep. Behind `powers` of the same z, f and Λ, whose
  // FMz⁻ and Ff it may use again; as often as wanted.
  virtual void update(Vector& z, const Vector& f, double c, FieldFactors before = {},
                      FieldFactors after = {}) const = 0;
};

class LinearPart;
class Space;

// `powers` and `update` by `increment` and `force`, where nothing is gained by fusing them.
class PlainPropagator : public Propagator {
 public:
  PlainPropagator(const Space& space, const LinearPart& linear) : space_(space), linear_(linear) {}  // which outlive it

  Powers powers(const Vector& z, const Vector& f, FieldFactors before) const override;
  void update(Vector& z, const Vector& f, double c, FieldFactors before, FieldFactors after) const override;

 private:
  const Space& space_;
  const LinearPart& linear_;
  mutable Vector z_, dz_, q_;  // z⁻, FMz⁻, Ff
};

// z ← Λz, field by field.
void multiply_fields(Propagator::FieldFactors factors, Vector& z);

// The propagators of the step sizes that a method asks for, the last `capacity` of them.
class Propagators {
 public:
  Propagators(const LinearPart& linear, PropagatorKind kind, std::size_t capacity);
  const Propagator& at(double h);

 private:
  const LinearPart& linear_;
  PropagatorKind kind_;
  StepCache<Propagator> cache_;
};

}  // namespace seiche
