// φ-functions of eight small matrices at a time: `phi_functions` and `PhiRowBlocks` (phi_functions.hpp), lane by lane.
#pragma once

#include <seiche/backend/lane_blocks.hpp>
#include <seiche/core/phi.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace seiche {

inline constexpr Index max_lane_phi_order = 16;

// NOLINTNEXTLINE(modernize-use-using): the attribute belongs to the type
typedef std::int64_t LaneIntegers __attribute__((vector_size(64)));

// How often each A is to be halved for a size ‖A‖ < ½, and 2^{−that}. The exponents are read from the bits of the numbers.
struct Halvings {
  LaneIntegers count{};
  Lanes factor{};
  std::int64_t most = 0;

  [[gnu::always_inline]] inline explicit Halvings(const Lanes& size) {
    constexpr std::int64_t bias = 1023, mantissa_bits = 52;
    constexpr std::int64_t most_halvings = 1000;  // infinity and what is no number among them
    const Lanes twice = 2.0 * size;
    LaneIntegers bits;
    static_assert(sizeof bits == sizeof twice);
    std::memcpy(&bits, &twice, sizeof bits);
    count = ((bits >> mantissa_bits) & 0x7ff) - (bias - 1);
    count = count > 0 ? count : LaneIntegers{};
    count = count < most_halvings ? count : LaneIntegers{} + most_halvings;
    for (int i = 0; i < lane_count; ++i) most = std::max<std::int64_t>(most, count[i]);
    const LaneIntegers power = (bias - count) << mantissa_bits;
    std::memcpy(&factor, &power, sizeof factor);
  }
};

// phi[k] ← φ_k(A), k = 0 … order ≤ max_lane_phi_order, for sizes ‖A‖ lane by lane. As `phi_functions`: Taylor's series of
// φ_order, the recurrence down from it, and as many doublings as each lane needs.
template <class Block>
[[gnu::always_inline]] inline void lane_phi_functions(const Block& A, const Lanes& size, int order, Block* phi) {
  constexpr int terms = 16;  // of an A below ½ with order ≥ 1: the next is below 1e-21
  const Halvings halvings(size);
  const Block small = halvings.factor * A;
  std::array<double, max_lane_phi_order + 1> inverse_factorial{};
  inverse_factorial[0] = 1;
  for (int k = 1; k <= order; ++k) inverse_factorial[k] = inverse_factorial[k - 1] / k;

  Block term{};
  term.add_to_diagonal(all_lanes(inverse_factorial[order]));
  Block sum = term;
  for (int i = 1; i <= terms; ++i) {
    term = all_lanes(1.0 / (order + i)) * (small * term);
    add_scaled(all_lanes(1.0), term, sum);
  }
  phi[order] = sum;
  for (int k = order - 1; k >= 0; --k) {
    phi[k] = small * phi[k + 1];
    phi[k].add_to_diagonal(all_lanes(inverse_factorial[k]));
  }
  for (std::int64_t j = 0; j < halvings.most; ++j) {
    const LaneMask undone = halvings.count > j;
    double scale = 1;
    for (int k = 0; k < order; ++k) scale /= 2;
    for (int k = order; k >= 0; --k, scale *= 2) {  // downwards: φ_k needs the undoubled φ_l with l ≤ k only
      Block doubled = phi[0] * phi[k];
      for (int l = k; l >= 1; --l) add_scaled(all_lanes(inverse_factorial[k - l]), phi[l], doubled);
      doubled = all_lanes(scale) * doubled;
      for (std::size_t e = 0; e < doubled.entries.size(); ++e)
        phi[k].entries[e] = choose(undone, doubled.entries[e], phi[k].entries[e]);
    }
  }
}

// block ← h Σ_k w_k φ_{k+1}, times S where the forces are gradients
template <class Block>
[[gnu::always_inline]] inline void lane_force_block(const Block* phi, const double* weights, int order, double h,
                                                    const Block* S, Block& block) {
  Block sum{};
  for (int k = 0; k < order; ++k) add_scaled(all_lanes(h * weights[k]), phi[k + 1], sum);
  block = S == nullptr ? sum : sum * *S;
}

}  // namespace seiche
