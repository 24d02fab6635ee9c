// S and M as sparse matrices, and their propagators.
#pragma once

#include <seiche/backend/sparse/pade_poles.hpp>
#include <seiche/core/grid/sparse_operators.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/core/system.hpp>

#include <memory>

namespace seiche {

// `support`: the components that V depends on, and predictors are asked for. Propagators throw Error where the factors
// of their resolvents would not fit into memory, as far as ResolventFactory::factor_bytes knows. Those by Lanczos
// iteration have none: they throw where the iteration does not settle. `space` outlives it.
std::unique_ptr<LinearPart> sparse_linear_part(const SparseMatrix& S, const SparseMatrix& M, Potential::Support support,
                                               const SparseOptions& options, const Space& space);

}  // namespace seiche
