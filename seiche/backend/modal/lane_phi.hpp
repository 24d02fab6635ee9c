// φ-functions of eight small matrices at a time: `phi_functions` and `PhiRowBlocks` (phi_functions.hpp), lane by lane.
#pragma once

#include <seiche/backend/modal/lane_blocks.hpp>
#include <seiche/core/phi.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace seiche {

inline constexpr Index max_lane_phi_order = 16;

// NOLINTNEXTLINE(modernize-use-using): the attribute belongs to the type
typedef std::int64_t LaneIntegers __attribute__((vector_size(64)));

// How often each A is to be halved for a size ‖A‖ < ½, and 2^{−that}. The exponents are read from the bits of the
// numbers.
struct Halvings {
  LaneIntegers count{};
  Lanes factor{};
  std::int64_t most = 0;

  [[gnu::always_inline]] inline explicit Halvings(const Lanes& size) {
    constexpr std::int64_t bias = 1023, mantissa_bits = 52;
    constexpr std::int64_t most_halvings = 1000;  // for infinity and NaN too
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

// Doublings let the modulus of what turns drift from the true one, by as many units of round-off as there are radians.
// It is known: that of e^λ, or the root of det e^A = e^{tr A}. X = e^A − I is scaled to it, where A turns at least
// twice as fast as it decays.
inline constexpr std::int64_t harmless_doublings = 8;

template <class Scalar, int m>
[[gnu::always_inline]] inline void keep_modulus(const ModeBlock<Scalar, m>&, const Halvings&, ModeBlock<Scalar, m>&) {}

[[gnu::always_inline]] inline void keep_modulus(const ModeBlock<ComplexLanes, 1>& A, const Halvings& halvings,
                                                ModeBlock<ComplexLanes, 1>& X) {
  if (halvings.most <= harmless_doublings) return;
  ComplexLanes& x = X(0, 0);
  for (int i = 0; i < lane_count; ++i) {
    const double modulus = std::hypot(1 + x.re[i], x.im[i]);
    if (halvings.count[i] <= harmless_doublings || 4 * square(A(0, 0).re[i]) > square(A(0, 0).im[i]) || !(modulus > 0))
      continue;
    const double s = std::exp(A(0, 0).re[i]) / modulus;
    x.re[i] = s * x.re[i] + (s - 1);
    x.im[i] *= s;
  }
}

[[gnu::always_inline]] inline void keep_modulus(const ModeBlock<Lanes, 2>& A, const Halvings& halvings,
                                                ModeBlock<Lanes, 2>& X) {
  if (halvings.most <= harmless_doublings) return;
  for (int i = 0; i < lane_count; ++i) {
    const double half_trace = (A(0, 0)[i] + A(1, 1)[i]) / 2;
    const double det_A = A(0, 0)[i] * A(1, 1)[i] - A(0, 1)[i] * A(1, 0)[i];
    const double det = (1 + X(0, 0)[i]) * (1 + X(1, 1)[i]) - X(0, 1)[i] * X(1, 0)[i];
    if (halvings.count[i] <= harmless_doublings || !(4 * square(half_trace) <= det_A) || !(det > 0)) continue;
    const double s = std::exp(half_trace) / std::sqrt(det);
    for (Lanes& x : X.entries) x[i] *= s;
    X(0, 0)[i] += s - 1;
    X(1, 1)[i] += s - 1;
  }
}

// phi[k] ← φ_k(A), k = 0 … order ≤ max_lane_phi_order, for sizes ‖A‖ lane by lane; phi[1] is written for order 0 too.
// As `phi_functions`: Taylor's series of φ_order, the recurrence down from it, and as many doublings as each lane
// needs, of e^A − I.
template <class Block>
[[gnu::always_inline]] inline void lane_phi_functions(const Block& A, const Lanes& size, int order, Block* phi) {
  constexpr int terms = 16;  // of an A below ½ with order ≥ 1: the next is below 1e-21
  const Halvings halvings(size);
  const Block small = halvings.factor * A;
  std::array<double, max_lane_phi_order + 1> inverse_factorial{};
  const int top = std::max(order, 1);  // φ₀ comes from φ₁
  inverse_factorial[0] = 1;
  for (int k = 1; k <= top; ++k) inverse_factorial[k] = inverse_factorial[k - 1] / k;

  Block term{};
  term.add_to_diagonal(all_lanes(inverse_factorial[top]));
  Block sum = term;
  for (int i = 1; i <= terms; ++i) {
    term = all_lanes(1.0 / (top + i)) * (small * term);
    add_scaled(all_lanes(1.0), term, sum);
  }
  phi[top] = sum;
  for (int k = top - 1; k >= 1; --k) {
    phi[k] = small * phi[k + 1];
    phi[k].add_to_diagonal(all_lanes(inverse_factorial[k]));
  }
  Block X = small * phi[1];  // e^A − I
  const auto update = [](const LaneMask& undone, const Block& doubled, Block& block) __attribute__((always_inline)) {
    for (std::size_t e = 0; e < doubled.entries.size(); ++e)
      block.entries[e] = choose(undone, doubled.entries[e], block.entries[e]);
  };
  for (std::int64_t j = 0; j < halvings.most; ++j) {
    const LaneMask undone = halvings.count > j;
    double scale = 1;
    for (int k = 0; k < order; ++k) scale /= 2;
    for (int k = order; k >= 1; --k, scale *= 2) {  // downwards: φ_k needs the undoubled φ_l with l ≤ k only
      Block doubled = X * phi[k];
      add_scaled(all_lanes(1.0), phi[k], doubled);
      for (int l = k; l >= 1; --l) add_scaled(all_lanes(inverse_factorial[k - l]), phi[l], doubled);
      update(undone, all_lanes(scale) * doubled, phi[k]);
    }
    Block doubled = X * X;
    add_scaled(all_lanes(2.0), X, doubled);
    update(undone, doubled, X);
  }
  keep_modulus(A, halvings, X);
  phi[0] = X;
  phi[0].add_to_diagonal(all_lanes(1.0));
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
