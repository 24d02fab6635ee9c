// Lanczos iteration with matrices that several processes hold together.
#pragma once

#include <seiche/backend/krylov/lanczos.hpp>
#include <seiche/petsc/petsc_system.hpp>
#include <seiche/petsc/solver/ksp_resolvents.hpp>

#include <memory>

namespace seiche {

// M⁻¹ by the linear solver that the equation names, whose only matrix M is; its definiteness may take factors of M once
// (is_nonnegative). S is skew; throws Error where M is not definite.
class PetscSkewSystem final : public SkewSystem {
 public:
  PetscSkewSystem(const PetscEquation& equation, const Product& of_S, const Product& of_M, const Space& of_states);
  void divide_by_M(Vector& f) const override;
  std::int64_t iterations() const { return resolvents_.iterations(); }

 private:
  KspResolvents resolvents_;
  std::unique_ptr<Resolvent> inverse_;
  mutable Vector right_;
};

}  // namespace seiche
