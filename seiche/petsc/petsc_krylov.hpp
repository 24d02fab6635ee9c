// φ-functions of matrices that several processes hold together.
#pragma once

#include <seiche/backend/krylov/krylov_phi.hpp>
#include <seiche/petsc/petsc_system.hpp>

namespace seiche {

// The kernel of S is taken to be {0}: a projection along z may move Casimirs.
std::unique_ptr<PhiEvaluator> petsc_phi(const PetscEquation& equation, Potential::Support support, const Space& space);

}  // namespace seiche
