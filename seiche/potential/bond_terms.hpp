// The bonds of a chain, divided among those who hold its points.
#pragma once

#include <seiche/core/grid/grid.hpp>
#include <seiche/core/potential.hpp>

namespace seiche {

// PointwisePotential::terms_at of a chain of `of` points, whose bonds belong to the point before them, and the first
// one between fixed ends to the first point. `free`: the same V of a chain with free ends.
std::vector<TermsOfPotential> bond_terms(const std::shared_ptr<const PointwisePotential>& free, Boundary boundary,
                                         Index first, Index count, Index of);

}  // namespace seiche
