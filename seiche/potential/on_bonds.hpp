// V(u) = Σ_j W(u_{j+1} − u_j) with any potential W per point, of one field.
#pragma once

#include <seiche/core/grid/grid.hpp>
#include <seiche/core/potential.hpp>

#include <memory>

namespace seiche {

// Bonds as in potential/bond.hpp, which is faster where W is known at compile time: N of them between N unknowns of a
// ring, one more between fixed ends (Dirichlet), one less between free ends (Neumann).
std::shared_ptr<const PointwisePotential> on_bonds(std::shared_ptr<const PointwisePotential> w, Boundary boundary);

}  // namespace seiche
