// A linear map on states.
#pragma once

#include <seiche/core/base/vector.hpp>

#include <memory>

namespace seiche {

class LinearMap {
 public:
  virtual ~LinearMap() = default;
  virtual void apply(const Vector& in, Vector& out) const = 0;  // out = A in; out must not be in
};

}  // namespace seiche
