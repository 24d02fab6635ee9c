// The nonlinear part V of H(z) = ½zᵀMz + V(z).
#pragma once

#include <seiche/core/vector.hpp>

#include <cstdint>
#include <memory>
#include <span>

namespace seiche {

// V on the physical values u of one field, or of several: then u holds them one after the other. Contracts, tested for
// every instance:
//   gradient is the gradient of value;   mean_gradient(a, b)·(b − a) = V(b) − V(a), free of cancellation;
//   along(p, q) gives the Taylor coefficients of x ↦ V(p + xq).
class PointwisePotential {
 public:
  virtual ~PointwisePotential() = default;
  virtual Index fields() const { return 1; }  // how many consecutive fields u holds
  virtual double value(std::span<const double> u) const = 0;
  virtual double magnitude(std::span<const double> u) const = 0;  // Σ|V_j|, the scale of round-off in V
  virtual double value_and_gradient(std::span<const double> u, std::span<double> gradient) const = 0;
  // ∫₀¹ ∇V(a + s(b − a)) ds
  virtual void mean_gradient(std::span<const double> a, std::span<const double> b, std::span<double> mean) const = 0;
  // Degree of V as a polynomial, or 0 if V is none; `along` needs degree + 1 coefficients and a polynomial V.
  virtual int degree() const = 0;
  virtual void along(std::span<const double> p, std::span<const double> q, std::span<double> coefficients) const = 0;
  // True if u·∇V(u) ≥ 0 for every u by the form of V: then damping that acts on u cannot raise V.
  virtual bool grows_outward() const = 0;
};

// V in the coordinates of State::z. Gradients are gradients in the inner product of Space and vanish outside support().
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
  virtual double value_and_gradient(const Vector& z, Vector& gradient) const = 0;
  virtual void mean_gradient(const Vector& a, const Vector& b, Vector& mean) const = 0;
  virtual int degree() const = 0;
  virtual void along(const Vector& p, const Vector& q, std::span<double> coefficients) const = 0;
  virtual Support support() const = 0;

  void gradient(const Vector& z, Vector& out) const { value_and_gradient(z, out); }
  const Counts& counts() const { return counts_; }

 protected:
  mutable Counts counts_;  // work done, for reports; not part of the value of V
};

}  // namespace seiche
