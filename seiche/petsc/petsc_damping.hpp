// A constant D that several processes hold together.
#pragma once

#include <seiche/core/damping.hpp>
#include <seiche/core/numerics/linear_map.hpp>
#include <seiche/petsc/solver/petsc_matrices.hpp>
#include <seiche/petsc/solver/solver_options.hpp>

#include <functional>
#include <memory>

namespace seiche {

std::unique_ptr<LinearMap> petsc_map(Mat a);  // z ↦ az

// As sparse_damping_flow: of D that is not diagonal by KspResolvents, whose iterations go to round-off.
std::function<std::unique_ptr<LinearMap>(double h)> petsc_damping_flow(Mat D, const Space& space,
                                                                       const SolverOptions& options);

// Dz alone, for systems that no Problem states. D null: none. `space` outlives it.
std::unique_ptr<Damping> petsc_damping(Mat D, const Space& space, Potential::Support support,
                                       const SolverOptions& options);

}  // namespace seiche
