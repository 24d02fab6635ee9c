// Poisson systems: a structure matrix that changes with the state, S(z) = S + S'(z).
#pragma once

#include <seiche/core/base/function_ref.hpp>
#include <seiche/core/base/vector.hpp>

#include <memory>
#include <span>
#include <string>

namespace seiche {

// S'(z) on the physical values of all fields, skew for every z: wᵀS'(z)w = 0.
class PointwiseStructure {
 public:
  // out ← ∂u of one field, by the difference that Problem::derivative states, which is skew.
  using Derivative = FunctionRef<void(std::span<const double> u, std::span<double> out)>;

  virtual ~PointwiseStructure() = default;
  virtual void apply(std::span<const double> z, std::span<const double> w, Derivative derivative,
                     std::span<double> out) const = 0;  // S'(z)w
  // True if solutions without damping keep the mean of every field: then projections on an energy keep it too.
  virtual bool keeps_means() const = 0;
  virtual std::string text() const = 0;  // "−(u∂ + ∂u)/3"
};

using StructurePointer = std::shared_ptr<const PointwiseStructure>;

// The same in the coordinates of State::z.
class Structure {
 public:
  virtual ~Structure() = default;
  virtual void apply(const Vector& z, const Vector& w, Vector& out) const = 0;
  virtual bool without_means(const Vector& z, Vector& d) const = 0;  // d ← z without its means; false: none is kept
};

}  // namespace seiche
