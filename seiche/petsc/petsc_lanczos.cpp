#include <seiche/core/base/error.hpp>
#include <seiche/petsc/petsc_lanczos.hpp>

namespace seiche {
namespace {

bool is_definite(Mat M) {
  constexpr double least = 1e-11;  // of the size of M: ten times what is_nonnegative takes for round-off
  PetscReal size = 0;
  require(MatNorm(M, NORM_INFINITY, &size));
  OwnedMat lowered;
  require(MatDuplicate(M, MAT_COPY_VALUES, lowered.make()));
  require(MatSetOption(lowered, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));  // of rows without a diagonal entry
  require(MatShift(lowered, -least * size));
  return is_nonnegative(lowered);
}

}  // namespace

PetscSkewSystem::PetscSkewSystem(const PetscEquation& equation, const Product& of_S, const Product& of_M,
                                 const Space& of_states)
    : SkewSystem(of_S, of_M, of_states), resolvents_(equation.M, equation.solver, 0), right_(of_states.size()) {
  OwnedMat symmetric_S;
  make_symmetric_part(equation.S, symmetric_S);
  if (!is_zero(symmetric_S)) throw lanczos_needs_skew_S();
  if (!is_definite(equation.M)) throw lanczos_needs_definite_M("there is a direction z with zᵀMz ≤ 0");
  inverse_ = resolvents_.make(1, 0);
}

void PetscSkewSystem::divide_by_M(Vector& f) const {
  right_ = f;
  inverse_->apply(right_, f);
}

}  // namespace seiche
