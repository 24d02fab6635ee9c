// What the ends of an axis ask of a real transform along it.
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

}  // namespace seiche
