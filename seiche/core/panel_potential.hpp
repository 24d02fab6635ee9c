// V on the physical values of many states at once, side by side in the columns of a panel.
#pragma once

#include <seiche/core/potential.hpp>
#include <seiche/core/simd/panel.hpp>

#include <memory>
#include <span>
#include <vector>

namespace seiche {

// Pointers to the first row of panels with one row per value; `gradient` and `mean` may be u and b. Each member has a
// potential of its own, or all have the same.
class PanelPotential {
 public:
  virtual ~PanelPotential() = default;
  virtual void value_and_gradient(const double* u, double* gradient, PanelValues& values) const = 0;
  virtual void value_and_magnitude(const double* u, PanelValues& values, PanelValues& magnitudes) const = 0;
  virtual void begin_means(const double* a) = 0;                        // between a, which is kept, and b
  virtual void mean_gradient(const double* b, double* mean) const = 0;  // for the same a as often as wanted
};

using PanelMembers = std::span<const std::shared_ptr<const PointwisePotential>>;  // one for every column

// For any potentials: each member by its own code, on its own numbers one behind the other. Panels are turned on the
// way, at the price of a pass. `rows` is the number of values that each reads.
std::unique_ptr<PanelPotential> member_by_member(PanelMembers members, Index rows);

}  // namespace seiche
