// V on the physical values of many states at once, side by side in the lanes of a panel.
#pragma once

#include <seiche/core/potential.hpp>
#include <seiche/core/simd/panel.hpp>

#include <memory>
#include <span>
#include <vector>

namespace seiche {

// Pointers to the first row of panels with one row per value; `gradient` must not overlap `u`. Each lane has a
// potential of its own, or all have the same.
class LanePotential {
 public:
  virtual ~LanePotential() = default;
  virtual void gradient(const double* u, double* gradient) const = 0;
  virtual void value_and_gradient(const double* u, double* gradient, LaneValues& values) const = 0;
  virtual void value_and_magnitude(const double* u, LaneValues& values, LaneValues& magnitudes) const = 0;
  virtual void mean_gradient(const double* a, const double* b, double* mean) const = 0;
};

using LaneMembers = std::span<const std::shared_ptr<const PointwisePotential>>;  // one for every lane

// For any potentials, one lane after the other. `rows` is the number of values that each reads.
std::unique_ptr<LanePotential> lane_by_lane(LaneMembers members, Index rows);

}  // namespace seiche
