// Rows of a panel in vector registers, for loops that are compiled for several instruction sets.
#pragma once

#include <seiche/core/simd/panel.hpp>

namespace seiche {

// 32 bytes are one register from AVX2 on, and half of one of AVX-512, which loses little: GCC keeps vectors that are
// wider than a register in memory, so 64 bytes would be far slower wherever AVX-512 is not. Where loops are compiled
// only once, for the baseline, 16 bytes are what every architecture has.
#ifdef SEICHE_MULTIVERSION_IS_ON
inline constexpr int pack_size = 4;
#else
inline constexpr int pack_size = 2;
#endif
inline constexpr int packs = static_cast<int>(panel_members) / pack_size;

// NOLINTNEXTLINE(modernize-use-using): the attributes belong to the type
typedef double Pack __attribute__((vector_size(pack_size * sizeof(double)), may_alias));

// The registers of one row, or of PanelValues. Loops over them have a length that the compiler knows, and unroll.
[[gnu::always_inline]] inline const Pack* packs_of(const double* row) { return reinterpret_cast<const Pack*>(row); }
[[gnu::always_inline]] inline Pack* packs_of(double* row) { return reinterpret_cast<Pack*>(row); }

}  // namespace seiche
