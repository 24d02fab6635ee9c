#include <seiche/core/base/error.hpp>
#include <seiche/petsc/petsc_lanczos.hpp>

namespace seiche {

PetscSkewSystem::PetscSkewSystem(const PetscEquation& equation, const Product& of_S, const Product& of_M,
                                 const Space& of_states)
    : SkewSystem(of_S, of_M, of_states), resolvents_(equation.M, equation.solver, 0), right_(of_states.size()) {
  constexpr double least = 1e-11;  // ten times what is_nonnegative takes for round-off
  if (!is_nonnegative(equation.M, least)) throw lanczos_needs_definite_M("there is a direction z with zᵀMz ≤ 0");
  inverse_ = resolvents_.make(1, 0);
}

void PetscSkewSystem::divide_by_M(Vector& f) const {
  right_ = f;
  inverse_->apply(right_, f);
}

}  // namespace seiche
