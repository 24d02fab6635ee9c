#include <seiche/core/simd/multiversion.hpp>
#include <seiche/core/simd/pack.hpp>
#include <seiche/potential/bond_panel.hpp>

namespace seiche {
namespace {

[[gnu::always_inline]] inline void subtract(const double* a, const double* b, double* out) {
#pragma GCC unroll 8
  for (int q = 0; q < packs; ++q) packs_of(out)[q] = packs_of(a)[q] - packs_of(b)[q];
}

}  // namespace

SEICHE_MULTIVERSION void panel_stretches(const double* u, Index rows, Boundary boundary, double* stretch) {
  const bool ring = boundary == Boundary::periodic;
  const PanelValues wall{};
  const double* last = u + (rows - 1) * panel_members;
  subtract(u, ring ? last : wall.data(), stretch);
  for (Index j = 1; j < rows; ++j)
    subtract(u + j * panel_members, u + (j - 1) * panel_members, stretch + j * panel_members);
  if (!ring) subtract(wall.data(), last, stretch + rows * panel_members);
}

SEICHE_MULTIVERSION void panel_pull(const double* tension, Index rows, Boundary boundary, double* gradient) {
  const bool ring = boundary == Boundary::periodic;
  for (Index j = 0; j < rows; ++j)
    subtract(tension + j * panel_members, ring && j + 1 == rows ? tension : tension + (j + 1) * panel_members,
             gradient + j * panel_members);
}

}  // namespace seiche
