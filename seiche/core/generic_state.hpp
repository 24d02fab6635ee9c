// States to try operators with.
#pragma once

#include <seiche/core/space.hpp>

#include <cmath>
#include <random>

namespace seiche {

// Without symmetries. Made of physical values: what a transform keeps at zero is zero here too.
inline Vector generic_state(const Space& space) {
  Vector physical(space.physical_size());
  for (Index i = 0; i < physical.size(); ++i) physical[i] = 1 + 0.5 * std::sin(static_cast<double>(i + 1));
  Vector z(space.size());
  space.from_physical(physical, z);
  return z;
}

// Of normally distributed physical values.
inline Vector random_state(const Space& space, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Vector physical(space.physical_size());
  for (double& x : physical) x = normal(random);
  Vector z(space.size());
  space.from_physical(physical, z);
  return z;
}

}  // namespace seiche
