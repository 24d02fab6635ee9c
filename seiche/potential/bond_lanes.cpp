#include <seiche/core/simd/multiversion.hpp>
#include <seiche/core/simd/pack.hpp>
#include <seiche/potential/bond_lanes.hpp>

namespace seiche {
namespace {

[[gnu::always_inline]] inline void subtract(const double* a, const double* b, double* out) {
#pragma GCC unroll 8
  for (int q = 0; q < packs; ++q) packs_of(out)[q] = packs_of(a)[q] - packs_of(b)[q];
}

}  // namespace

SEICHE_MULTIVERSION void lane_stretches(const double* u, Index rows, Boundary boundary, double* stretch) {
  const bool ring = boundary == Boundary::periodic;
  const LaneValues wall{};
  const double* last = u + (rows - 1) * lanes;
  subtract(u, ring ? last : wall.data(), stretch);
  for (Index j = 1; j < rows; ++j) subtract(u + j * lanes, u + (j - 1) * lanes, stretch + j * lanes);
  if (!ring) subtract(wall.data(), last, stretch + rows * lanes);
}

SEICHE_MULTIVERSION void lane_pull(const double* tension, Index rows, Boundary boundary, double* gradient) {
  const bool ring = boundary == Boundary::periodic;
  for (Index j = 0; j < rows; ++j)
    subtract(tension + j * lanes, ring && j + 1 == rows ? tension : tension + (j + 1) * lanes, gradient + j * lanes);
}

}  // namespace seiche
