// V that joins points, of those that one process holds and the ones beside them.
#pragma once

#include <seiche/core/grid/ranks.hpp>
#include <seiche/core/potential.hpp>

#include <memory>

namespace seiche {

// V of the points of `part`, whose values of other processes that its terms read are exchanged at every evaluation;
// null where V does not tell its terms. `ranks` outlives it; all of them make it, and call it, together.
std::shared_ptr<const PointwisePotential> halo_potential(const PointwisePotential& whole, const FieldPart& part,
                                                         const Ranks& ranks);

}  // namespace seiche
