// Structure matrices that change with the state, S(z) = S + S'(z): Poisson systems, and mobilities M(u).
#pragma once

#include <seiche/core/base/function_ref.hpp>
#include <seiche/core/base/vector.hpp>

#include <memory>
#include <span>
#include <string>

namespace seiche {

// S'(z) on the physical values of all fields: skew for every z, wᵀS'(z)w = 0, or such that S(z) ⪯ 0.
class PointwiseStructure {
 public:
  // out ← ∂u of one field along an axis, by the difference that Problem::derivatives states, which is skew.
  using Derivative = FunctionRef<void(std::span<const double> u, Index axis, std::span<double> out)>;

  virtual ~PointwiseStructure() = default;
  virtual void apply(std::span<const double> z, std::span<const double> w, Derivative derivative,
                     std::span<double> out) const = 0;  // S'(z)w
  // True if solutions without damping keep the mean of every field: then projections on an energy keep it too.
  virtual bool keeps_means() const = 0;
  virtual bool dissipates() const { return false; }  // S'(z) is not skew, and S(z) ⪯ 0 for every z
  // Where in z a coefficient is out of its bounds, so that another stands for it; "" for nowhere.
  virtual std::string complaint_about(std::span<const double> /*z*/) const { return ""; }
  virtual std::string text() const = 0;  // "−(u∂ + ∂u)/3"
};

using StructurePointer = std::shared_ptr<const PointwiseStructure>;

// A coefficient that follows a field: f(u).
class StateFunction {
 public:
  virtual ~StateFunction() = default;
  virtual double operator()(double u) const = 0;
  virtual std::string text() const = 0;
};
using StateFunctionPointer = std::shared_ptr<const StateFunction>;

// The same in the coordinates of State::z.
class Structure {
 public:
  virtual ~Structure() = default;
  virtual void apply(const Vector& z, const Vector& w, Vector& out) const = 0;
  virtual bool dissipates() const = 0;                               // as PointwiseStructure::dissipates
  virtual bool without_means(const Vector& z, Vector& d) const = 0;  // d ← z without its means; false: none is kept
};

}  // namespace seiche
