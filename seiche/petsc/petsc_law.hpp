// The hypotheses of the energy law, of matrices that several processes hold together.
#pragma once

#include <seiche/core/run_report.hpp>
#include <seiche/petsc/petsc_system.hpp>

#include <string>

namespace seiche {

// Throws Error where M is not symmetric or M ⪰ 0 fails.
void require_hypotheses(const PetscEquation& equation);

// S ← S − D and no D, for methods that take the damping as part of S; `S_less_D` holds that. Throws Error, which names
// the method, where Dz is not D∇H(z): D is to act on components with ∂H/∂zᵢ = zᵢ alone.
void merge_damping(PetscEquation& equation, Potential::Support support, const std::string& method, OwnedMat& S_less_D);

// What is promised of H along exact solutions, by the signs of sym(S) and sym(MD).
LawPromise promise_energy_law(const PetscEquation& equation, Potential::Support support, const Space& space);

}  // namespace seiche
