// Potentials of W by formula: the polynomial fast paths where W is one, a compiled formula otherwise.
#pragma once

#include <seiche/config/custom/energy_split.hpp>
#include <seiche/core/grid/grid.hpp>

#include <memory>
#include <string>
#include <vector>

namespace seiche {

// V = Σ_j W(u_j), of one field or several.
std::shared_ptr<const PointwisePotential> point_potential(const FieldFormula& w, const Grid& grid);

// V = Σ_j W(u_{j+1} − u_j), on a ring or between fixed ends.
std::shared_ptr<const PointwisePotential> bond_potential(const FieldFormula& w, const Grid& grid);

// V = Σ_j W(u_j) with W by a formula in these fields, none of which it leaves out; null where it is a constant. With
// `grows_outward` the caller vouches for u·∇V ≥ 0 where the form of W does not tell.
std::shared_ptr<const PointwisePotential> point_potential(const std::string& key, const std::string& text,
                                                          const std::vector<std::string>& fields,
                                                          bool grows_outward = false);

}  // namespace seiche
