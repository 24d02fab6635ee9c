// Kicks and drifts on the points of a grid.
#pragma once

#include <seiche/core/grid/sparse_operators.hpp>
#include <seiche/core/kicks.hpp>
#include <seiche/core/potential.hpp>

#include <memory>

namespace seiche {

// Each kick and the drift after it in one pass over the points: the new positions go to another array, since the force
// on the next point still asks for the old ones. K: the block of M of the positions, of differences on a grid; V of the
// positions, or null. Counts its gradients with `potential`, which outlives it.
std::unique_ptr<Kicks> grid_kicks(const SparseMatrix& K, std::shared_ptr<const PointwisePotential> V,
                                  const Potential& potential);

}  // namespace seiche
