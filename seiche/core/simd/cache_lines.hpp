// Numbers whose first begins a line of the cache: eight of them are read at once wherever eight begin.
#pragma once

#include <seiche/core/simd/lanes.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace seiche {

class CacheLines {
 public:
  CacheLines() = default;
  explicit CacheLines(std::size_t numbers) : lines_(groups_of_lanes(numbers)) {}  // zeros

  double* data() { return reinterpret_cast<double*>(lines_.data()); }
  const double* data() const { return reinterpret_cast<const double*>(lines_.data()); }

 private:
  struct alignas(64) Line {
    std::array<double, lane_count> numbers{};
  };
  std::vector<Line> lines_;
};

}  // namespace seiche
