// ℝⁿ with its coordinates: the only place that knows what the numbers in State::z are.
#pragma once

#include <seiche/core/vector.hpp>

namespace seiche {

// Coordinates are orthonormal: the Euclidean product of two states is that of their physical values.
class Space {
 public:
  virtual ~Space() = default;
  virtual Index size() const = 0;           // of State::z; may hold slots that are always zero
  virtual Index physical_size() const = 0;  // fields × unknowns
  virtual void to_physical(const Vector& z, Vector& values) const = 0;
  virtual void from_physical(const Vector& values, Vector& z) const = 0;

  Vector physical(const Vector& z) const;
};

}  // namespace seiche
