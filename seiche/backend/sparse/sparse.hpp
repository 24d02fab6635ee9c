// The sparse backend: physical coordinates, coefficients that may change from point to point, any graph.
#pragma once

#include <seiche/core/system.hpp>

namespace seiche {

// Takes problems stated by matrices, or by stencils of finite differences. Throws Error where derivatives are spectral,
// or the options do not fit.
System sparse_system(const Problem& problem, const BackendOptions& options);

// A bound of the fastest rate of a problem, the spectral radius of SM − D₀. Throws Error as sparse_system.
double sparse_rate(const Problem& problem);

// True if its system has Kicks: q̇ = p, ṗ = −Kq − ∇V(q) with differences on a grid, and V of all positions or
// of none.
bool has_grid_kicks(const Problem& problem);

// Of matrices, and where propagators are factorised of their factors.
double sparse_bytes(const Problem& problem, double factored);

}  // namespace seiche
