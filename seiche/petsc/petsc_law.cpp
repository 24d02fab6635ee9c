#include <seiche/core/base/error.hpp>
#include <seiche/petsc/petsc_law.hpp>

namespace seiche {

void require_hypotheses(const PetscEquation& equation) {
  OwnedMat skew;
  make_symmetric_part(equation.M, skew);
  add(-1, equation.M, skew);
  PetscReal asymmetry = 0, size = 0;
  require(MatNorm(skew, NORM_INFINITY, &asymmetry));
  require(MatNorm(equation.M, NORM_INFINITY, &size));
  if (!(asymmetry <= 4 * epsilon * size))
    throw Error("M must be symmetric and finite, but it differs from its transpose by {:.3g} in the sum of a row",
                2 * asymmetry);
  if (!is_nonnegative(equation.M))
    throw Error("M must be positive semidefinite, and there is a direction z with zᵀMz < 0");
}

void merge_damping(PetscEquation& equation, Potential::Support support, const std::string& method, OwnedMat& S_less_D) {
  OwnedMat DM;
  multiply(equation.D, equation.M, DM);
  add(-1, equation.D, DM);
  // Columns of D that V depends on: those that D takes from ones in the support.
  Vector ones = Vector::Zero(local_rows(equation.D)), image = ones;
  ones.segment(support.begin, support.size).setOnes();
  OwnedMat sizes;
  make_absolute(equation.D, sizes);
  PetscProduct(sizes).apply(ones, image);
  double sees_V = image.size() > 0 ? image.lpNorm<Eigen::Infinity>() : 0.0;
  equation.ranks->max({&sees_V, 1});
  if (!is_zero(DM) || sees_V != 0)
    throw Error(
        "{} does not apply: a method that merges the damping into S needs Dz = D∇H(z), and here it is not; methods that "
        "split the damping off (savf, seavf, seisav, seilm, …) and egc2 … egc8 take it",
        method);
  require(MatDuplicate(equation.S, MAT_COPY_VALUES, S_less_D.make()));
  add(-1, equation.D, S_less_D);
  equation.S = S_less_D;
  equation.D = nullptr;
}

LawPromise promise_energy_law(const PetscEquation& equation, Potential::Support support, const Space& space) {
  LawPromise law;
  OwnedMat feeding;  // −sym(S)
  make_symmetric_part(equation.S, feeding);
  require(MatScale(feeding, -1));
  const bool is_skew = is_zero(feeding);
  if (!is_skew && !is_nonnegative(feeding)) {
    law.reason = "sym(S) ⪯ 0 fails";
    return law;
  }
  if (equation.D != nullptr) {
    if (space.any(has_entries(equation.D, support))) {
      law.reason = "the damping acts on components that V depends on, and may raise V";
      return law;
    }
    OwnedMat MD, part;
    multiply(equation.M, equation.D, MD);
    make_symmetric_part(MD, part);
    if (!is_nonnegative(part)) {
      law.reason = "sym(MD) ⪰ 0 fails";
      return law;
    }
  }
  law.promised = law.never_grows = true;
  law.never_changes = is_skew && equation.D == nullptr;
  law.reason = equation.D != nullptr ? "sym(MD) ⪰ 0 and V does not depend on the damped components"
                                     : "sym(S) ⪯ 0 and no damping flow";
  return law;
}

}  // namespace seiche
