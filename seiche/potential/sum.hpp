// V = V₁ + V₂ + …, each of some of the fields.
#pragma once

#include <seiche/core/potential.hpp>

#include <memory>
#include <vector>

namespace seiche {

struct PlacedPotential {
  std::shared_ptr<const PointwisePotential> potential;
  Index first_field = 0;  // of those it reads
};

// Of so many fields. None of the parts is a sum itself. One part that reads them all is returned as it is; none gives
// null.
std::shared_ptr<const PointwisePotential> sum_of(const std::vector<PlacedPotential>& parts, Index fields);

}  // namespace seiche
