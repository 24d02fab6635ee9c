// What a TS says of its equation u̇ = S∇F(u) − Du, F(u) = ½uᵀMu + V(u), as a Problem.
#pragma once

#include <seiche/core/problem.hpp>
#include <seiche/petsc/petsc_call.hpp>

#include <petscts.h>

#include <span>
#include <vector>

namespace seiche {

// Of TSDiscGradSetFormulation: S, F and ∇F, each of which may be missing.
struct TsFormulation {
  PetscErrorCode (*S)(TS, PetscReal, Vec, Mat, void*) = nullptr;
  PetscErrorCode (*F)(TS, PetscReal, Vec, PetscScalar*, void*) = nullptr;
  PetscErrorCode (*gradient)(TS, PetscReal, Vec, Vec, void*) = nullptr;
  void* context = nullptr;
};

// ∇V has an entry where it had none before: V depends on more components of u than Problem::potential_field says.
class SupportGrew : public std::exception {
 public:
  const char* what() const noexcept override { return "V depends on components of u that its gradient did not show"; }
};

// Matrices S, M and D composed with the TS win over its formulation, and so does a Tao V, which knows V and ∇V; without
// one V is F − ½uᵀMu, and 0 where there is no formulation either. In the coordinates z of the problem the components
// that V depends on come first where they are half of all: positions before momenta, however the user orders them.
class TsEquation {
 public:
  // The type of `ts`; u has the layout of its solutions. Throws Error, with what to call, where M or S is missing, S
  // changes with u, or a matrix does not fit; PetscFailure where a function of the user's fails.
  TsEquation(TS ts, const TsFormulation& formulation, Vec u, bool is_separable);

  const Problem& problem() const { return problem_; }
  // From here on V is asked for at these momenta, so that one on which it depends after all shows: SupportGrew.
  void hold_momenta(const Vector& z);
  void to_state(Vec u, Vector& z) const;
  void to_solution(const Vector& z, Vec u) const;

 private:
  class Functions;

  bool find_positions(const Vector& start);
  SparseMatrix structure(TS ts, const TsFormulation& formulation, const Vector& start);

  std::shared_ptr<Functions> functions_;
  std::vector<Index> order_;  // order_[i]: the component of u that is component i of z
  Problem problem_;
};

}  // namespace seiche
