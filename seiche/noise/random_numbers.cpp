#include <seiche/core/simd/vector_functions.hpp>
#include <seiche/noise/random_numbers.hpp>

#include <Random123/philox.h>

#include <algorithm>
#include <array>
#include <numbers>

namespace seiche {
namespace {

constexpr Index in_one = 4;      // numbers of one counter
constexpr Index counters = 128;  // at a time
constexpr Index in_block = in_one * counters;

// In [0, 1).
double uniform(std::uint64_t bits) { return static_cast<double>(bits >> 11U) * 0x1p-53; }

// The block of numbers that begins with this counter.
void fill_block(const RandomRow& row, Index counter, std::span<double, in_block> out) {
  constexpr Index pairs = in_block / 2;
  std::array<double, pairs> radius, angle, sine, cosine;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  const r123::Philox4x64::key_type key = {{row.seed, row.stream}};
  for (Index i = 0; i < counters; ++i) {
    const r123::Philox4x64::ctr_type count = {{static_cast<std::uint64_t>(counter + i), row.step, row.part, 0}};
    const r123::Philox4x64::ctr_type bits = r123::Philox4x64()(count, key);
    for (Index j = 0; j < 2; ++j) {
      const auto at = static_cast<std::size_t>(2 * i + j);
      radius[at] = 1 - uniform(bits[static_cast<std::size_t>(2 * j)]);  // above 0
      angle[at] = 2 * std::numbers::pi * uniform(bits[static_cast<std::size_t>(2 * j + 1)]);
    }
  }
  const VectorFunctions& f = vector_functions();
  f.log(radius.data(), radius.data(), pairs);
  for (double& r : radius) r *= -2;
  f.sqrt(radius.data(), radius.data(), pairs);
  f.sincos(angle.data(), sine.data(), cosine.data(), pairs);
  for (std::size_t i = 0; i < pairs; ++i) {
    out[2 * i] = radius[i] * cosine[i];
    out[2 * i + 1] = radius[i] * sine[i];
  }
}

}  // namespace

void normal_numbers(const RandomRow& row, Index first, std::span<double> out) {
  std::array<double, in_block> block;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  const Index end = first + static_cast<Index>(out.size());
  for (Index at = first; at < end;) {
    const Index begin = at / in_block * in_block;  // of the block
    const Index stop = std::min(begin + in_block, end);
    fill_block(row, begin / in_one, block);
    std::copy(block.begin() + (at - begin), block.begin() + (stop - begin), out.begin() + (at - first));
    at = stop;
  }
}

}  // namespace seiche
