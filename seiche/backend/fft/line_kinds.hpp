// What the ends of an axis ask of a real transform along it, and the factors of its numbers.
#pragma once

#include <seiche/core/grid/grid.hpp>

#include <vector>

namespace seiche {

struct LineKinds {
  int forward, inverse;  // fftw_r2r_kind
};
LineKinds kinds_of(Boundary boundary);

// Positions of the modes that stand for themselves only, not for a pair: the constant, and the alternating one.
std::vector<Index> modes_alone(const GridAxis& axis);

// Factors of numbers between FFTW's sums along one axis and orthonormal coordinates; those of the modes whose conjugate
// is not held too (constant, alternating) are √2 larger before to_values, and smaller after to_slots, which the
// transforms above see to.
double slot_scale(const GridAxis& axis);
double value_scale(const GridAxis& axis);

}  // namespace seiche
