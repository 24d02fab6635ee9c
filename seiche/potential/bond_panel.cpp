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

Index bond_count(Index rows, Boundary boundary) {
  switch (boundary) {
    case Boundary::periodic: return rows;
    case Boundary::dirichlet: return rows + 1;
    case Boundary::neumann: break;
  }
  return rows - 1;
}

SEICHE_MULTIVERSION void panel_stretches(const double* u, Index rows, Boundary boundary, double* stretch) {
  const PanelValues wall{};
  const double* last = u + (rows - 1) * panel_members;
  if (boundary != Boundary::neumann) {
    subtract(u, boundary == Boundary::periodic ? last : wall.data(), stretch);
    stretch += panel_members;
  }
  for (Index j = 1; j < rows; ++j)
    subtract(u + j * panel_members, u + (j - 1) * panel_members, stretch + (j - 1) * panel_members);
  if (boundary == Boundary::dirichlet) subtract(wall.data(), last, stretch + (rows - 1) * panel_members);
}

SEICHE_MULTIVERSION void panel_pull(const double* tension, Index rows, Boundary boundary, double* gradient) {
  const PanelValues none{};
  const auto bond = [&](Index j) { return tension + j * panel_members; };
  for (Index j = 0; j < rows; ++j) {
    const double *before = bond(j), *after = bond(j + 1);
    if (boundary == Boundary::neumann) {
      before = j == 0 ? none.data() : bond(j - 1);
      after = j + 1 == rows ? none.data() : bond(j);
    } else if (boundary == Boundary::periodic && j + 1 == rows) {
      after = tension;
    }
    subtract(before, after, gradient + j * panel_members);
  }
}

}  // namespace seiche
