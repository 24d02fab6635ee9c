// The nonlinear part V of H(z) = ½zᵀMz + V(z).
#pragma once

#include <seiche/core/base/value_and_magnitude.hpp>
#include <seiche/core/base/vector.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace seiche {

class PanelPotential;
class PointwisePotential;

// Some terms of a V that joins points: a potential of the values at these points, of the fields from `first_field` on.
struct TermsOfPotential {
  static constexpr Index held = -1;  // in the place of a point: what does not move, u = 0
  std::vector<Index> points;
  std::shared_ptr<const PointwisePotential> potential;
  bool is_counted = true;  // where its value belongs
  Index first_field = 0;
};

// V on the physical values u of one field, or of several: then u holds them one after the other. Contracts, tested for
// every instance:
//   gradient is the gradient of value;   mean_gradient(a, b)·(b − a) = V(b) − V(a), free of cancellation;
//   along(p, q) gives the Taylor coefficients of x ↦ V(p + xq).
class PointwisePotential {
 public:
  virtual ~PointwisePotential() = default;
  virtual Index fields() const { return 1; }  // how many consecutive fields u holds
  // True if V = Σ_j W(u_j): then parts of u may be given one at a time, on several threads.
  virtual bool is_local() const { return false; }
  // True if V = Σ_j W_j(u_j, v_j, …), with the values of all fields at point j.
  virtual bool is_pointwise() const { return is_local(); }
  // Such a V of so many points from `first` on; null where all points are alike, and it is this one.
  virtual std::shared_ptr<const PointwisePotential> at_points(Index /*first*/, Index /*count*/) const {
    return nullptr;
  }
  // Of a V of `of` points, the terms that belong to so many of them from `first` on, and, not counted, those of other
  // points that reach them: of all parts of the points together the counted terms are V, each once. Nothing where V
  // cannot tell.
  virtual std::optional<std::vector<TermsOfPotential>> terms_at(Index /*first*/, Index /*count*/, Index /*of*/) const {
    return std::nullopt;
  }
  // What speaks against V, or "": a gradient that is not its own where it begins, at u, or nearby. Asked before a run.
  virtual std::string complaint(std::span<const double> /*u*/) const { return ""; }
  virtual double value(std::span<const double> u) const = 0;
  virtual ValueAndMagnitude value_and_magnitude(std::span<const double> u)
      const = 0;  // V and Σ|V_j|, the sizes of the terms of V_j, or a bound of its round-off/ε
  double magnitude(std::span<const double> u) const { return value_and_magnitude(u).magnitude; }
  virtual double value_and_gradient(std::span<const double> u, std::span<double> gradient) const = 0;
  virtual void gradient(std::span<const double> u, std::span<double> out) const { value_and_gradient(u, out); }
  // In place, between two transforms: with u = in · values, values ← out · ∇V(u); returns V(u).
  virtual double value_and_gradient_in_place(double in, double out, std::span<double> values) const;
  // By how much round-off may change each component of ∇V(u), in units of ε, where terms cancel in it. Zero here: by no
  // more than round-off in u does.
  virtual void gradient_round_off(std::span<const double> /*u*/, std::span<double> bounds) const {
    std::fill(bounds.begin(), bounds.end(), 0.0);
  }
  // ∫₀¹ ∇V(a + s(b − a)) ds, or another mean of gradients with the contract above
  virtual void mean_gradient(std::span<const double> a, std::span<const double> b, std::span<double> mean) const = 0;
  // Degree of V as a polynomial, or 0 if it is not one; `along` needs degree + 1 coefficients and a polynomial V.
  virtual int degree() const = 0;
  virtual void along(std::span<const double> p, std::span<const double> q, std::span<double> coefficients) const = 0;
  // d if V(xu) = xᵈV(u) for every u, or 0 if there is no such d: then `along` from the origin is known from V(u).
  virtual int homogeneity() const { return 0; }
  // True if u·∇V(u) ≥ 0 for every u by the form of V: then damping that acts on u cannot raise V.
  virtual bool grows_outward() const = 0;
  // The same of the fields from this one on, whatever those before it are: Σ_{i ≥ first} uᵢ·∂V/∂uᵢ ≥ 0. A kinetic
  // energy ½pᵀA(q)p does so with A ⪰ 0.
  virtual bool grows_outward_from(Index first) const { return first == 0 && grows_outward(); }
  // `members`, of which this is one, side by side in the columns of panels with `rows` values each; one after the other
  // where that is not written for the potential.
  virtual std::unique_ptr<PanelPotential> for_members(
      std::span<const std::shared_ptr<const PointwisePotential>> members, Index rows) const;
};

// V in the coordinates of State::z. Gradients are gradients in the inner product of Space. They vanish outside
// support(), and so does every vector that is passed for one: only the components of the support are written.
class Potential {
 public:
  struct Support {  // the components of z that V depends on
    Index begin = 0;
    Index size = 0;
  };
  struct Counts {
    std::int64_t gradients = 0;
    std::int64_t values = 0;
  };

  virtual ~Potential() = default;
  virtual double value(const Vector& z) const = 0;
  virtual double magnitude(const Vector& z) const = 0;
  virtual ValueAndMagnitude value_and_magnitude(const Vector& z) const { return {value(z), magnitude(z)}; }
  virtual double value_and_gradient(const Vector& z, Vector& gradient) const = 0;  // the gradient may be z itself
  virtual void mean_gradient(const Vector& a, const Vector& b, Vector& mean) const = 0;
  // PointwisePotential::gradient_round_off, in the coordinates of a gradient.
  virtual void gradient_round_off(const Vector& /*z*/, Vector& bounds) const { bounds.setZero(); }
  virtual int degree() const = 0;
  virtual void along(const Vector& p, const Vector& q, std::span<double> coefficients) const = 0;
  virtual void along_ray(const Vector& z, std::span<double> coefficients) const = 0;  // of x ↦ V(xz)
  // d if V(xz) = xᵈV(z) for every z, so that zᵀ∇V(z) = dV(z); or 0 if there is no such d.
  virtual int homogeneity() const { return 0; }
  virtual Support support() const = 0;

  void gradient(const Vector& z, Vector& out) const { value_and_gradient(z, out); }
  const Counts& counts() const { return counts_; }
  void count_gradient() const { ++counts_.gradients; }  // one that was taken around this class

 protected:
  mutable Counts counts_;  // work done, for reports; not part of the value of V
};

}  // namespace seiche
