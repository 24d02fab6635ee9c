// A state without symmetries, to try operators with.
#pragma once

#include <seiche/core/space.hpp>

#include <cmath>

namespace seiche {

// Made of physical values: what a transform keeps at zero is zero here too.
inline Vector generic_state(const Space& space) {
  Vector physical(space.physical_size());
  for (Index i = 0; i < physical.size(); ++i) physical[i] = 1 + 0.5 * std::sin(static_cast<double>(i + 1));
  Vector z(space.size());
  space.from_physical(physical, z);
  return z;
}

}  // namespace seiche
