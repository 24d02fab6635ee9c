// An equation whose matrices several processes hold together, as a System.
#pragma once

#include <seiche/core/system.hpp>
#include <seiche/petsc/solver/petsc_matrices.hpp>
#include <seiche/petsc/solver/solver_options.hpp>

#include <memory>

namespace seiche {

// ż = S∇H − Dz, H = ½zᵀMz + V, with S, M and D of AIJ kinds and one layout of rows; D null: none. `ranks`, the
// processes of their communicator, outlives the system.
struct PetscEquation {
  Mat S = nullptr, M = nullptr, D = nullptr;
  const Ranks* ranks = nullptr;
  SolverOptions solver = SolverOptions();
};

// All but V, the damping and z₀, which the caller adds before a method is made: propagators by KspResolvents or Lanczos
// iteration, φ-functions by Krylov spaces. `support`: of V, in the part of z that is here. An iterative solver holds to
// its tolerance; closures keep their law to round-off all the same, by a Restoration, where S is skew.
System petsc_system(const PetscEquation& equation, std::unique_ptr<Space> of_states, Potential::Support support,
                    const SparseOptions& options);
// Rows side by side, those of each process in one array.
std::unique_ptr<Space> row_space(Index rows, const Ranks& ranks);

}  // namespace seiche
