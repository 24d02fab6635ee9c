// An equation whose matrices several processes hold together, as a System.
#pragma once

#include <seiche/core/run_report.hpp>
#include <seiche/core/system.hpp>
#include <seiche/petsc/petsc_matrices.hpp>

#include <cstdint>
#include <memory>
#include <string>

namespace seiche {

// ż = S∇H − Dz, H = ½zᵀMz + V, with S, M and D of AIJ kinds and one layout of rows; D null: none. They outlive the
// system, and so does `ranks`, the processes of their communicator.
struct PetscEquation {
  Mat S = nullptr, M = nullptr, D = nullptr;
  const Ranks* ranks = nullptr;
};

// Throws Error where M is not symmetric or M ⪰ 0 fails.
void require_hypotheses(const PetscEquation& equation);

// S ← S − D and no D, for methods that take the damping as part of S; `S_less_D` holds that. Throws Error, which names
// the method, where Dz is not D∇H(z): D is to act on components with ∂H/∂zᵢ = zᵢ alone.
void merge_damping(PetscEquation& equation, Potential::Support support, const std::string& method, OwnedMat& S_less_D);

// What is promised of H along exact solutions, by the signs of sym(S) and sym(MD).
LawPromise promise_energy_law(const PetscEquation& equation, Potential::Support support, const Space& space);

// What KSP has done for propagators, and the largest relative move by which they restored their contract.
struct SolverShare {
  std::int64_t iterations = 0;
  double restored = 0.0;
};

// All but V and z₀, which the caller adds before a method is made: propagators by KspResolvents, φ-functions by Krylov
// spaces. `support`: of V, in the part of z that is here.
// An iterative solver holds to its tolerance; closures keep their law to round-off all the same, by
// restoring_pade_propagator, where S is skew.
System petsc_system(const PetscEquation& equation, Potential::Support support, const SparseOptions& options);
SolverShare solver_share(const System& system);  // of such a system

}  // namespace seiche
