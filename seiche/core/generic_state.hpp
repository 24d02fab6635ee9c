// States to try operators with.
#pragma once

#include <seiche/core/space.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace seiche {

// Without symmetries. Made of physical values: what a transform keeps at zero is zero here too.
inline Vector generic_state(const Space& space) {
  Vector physical(space.physical_size());
  const Space::Field field = space.values();
  for (Index i = 0; i < physical.size(); ++i) {
    const Index of_all = i / field.size * field.of + field.first + i % field.size;
    physical[i] = 1 + 0.5 * std::sin(static_cast<double>(of_all + 1));
  }
  Vector z(space.size());
  space.from_physical(physical, z);
  return z;
}

// Of normally distributed physical values.
inline Vector random_state(const Space& space, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Vector physical(space.physical_size());
  const Space::Field field = space.values();
  for (Index f = 0; f < physical.size(); f += std::max<Index>(field.size, 1))
    for (Index i = 0; i < field.of; ++i) {  // every process draws for all
      const double x = normal(random);
      if (i >= field.first && i < field.first + field.size) physical[f + i - field.first] = x;
    }
  Vector z(space.size());
  space.from_physical(physical, z);
  return z;
}

}  // namespace seiche
