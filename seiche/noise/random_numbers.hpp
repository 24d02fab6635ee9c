// Random numbers that are counted and not drawn: each is a function of its place.
#pragma once

#include <seiche/core/base/vector.hpp>

#include <cstdint>
#include <span>

namespace seiche {

// One row of infinitely many independent standard normal numbers: another one for another seed, stream, step or part.
struct RandomRow {
  std::uint64_t seed = 0, stream = 0;
  std::uint64_t step = 0, part = 0;
};

// out ← the numbers `first`, first + 1, … of the row. Each depends on the row and its own place alone: the same for
// however many threads and processes take their share, in whatever order. Philox 4×64 with ten rounds (Salmon, Moraes,
// Dror, Shaw 2011), and Box and Muller's (1958) transform.
void normal_numbers(const RandomRow& row, Index first, std::span<double> out);

}  // namespace seiche
