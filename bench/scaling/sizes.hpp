// What is measured at every size.
#pragma once

#include <bench/floor.hpp>
#include <seiche/core/base/vector.hpp>

#include <cmath>
#include <vector>

namespace seiche::bench {

struct SizeCost {
  Index points;
  Floor floor;

  double per_point(double seconds) const { return 1e9 * seconds / static_cast<double>(points); }  // nanoseconds
  double levels() const { return std::log2(static_cast<double>(points)); }
};

struct SizeMemory {
  Index points;
  double peak;     // bytes
  double program;  // of them held whatever the size

  double doubles_per_unknown() const { return (peak - program) / (8.0 * 2.0 * static_cast<double>(points)); }
};

// p of time ∝ (N log₂ N)^p by least squares over N ≥ `smallest`, below which a step has costs that do not grow.
double growth_exponent(const std::vector<SizeCost>& costs, double Floor::*time, Index smallest);

}  // namespace seiche::bench
