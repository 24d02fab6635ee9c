// What a TS says of its equation u̇ = S∇F(u) − Du, F(u) = ½uᵀMu + V(u).
#pragma once

#include <seiche/core/problem.hpp>
#include <seiche/petsc/petsc_system.hpp>
#include <seiche/petsc/ts_functions.hpp>

#include <array>
#include <memory>

namespace seiche {

// Matrices S, M and D composed with the TS win over its formulation. In the coordinates z of the equation the
// components that V depends on come first on each process where they are half of all: positions before momenta, however
// the user orders them.
class TsEquation {
 public:
  // u has the layout of the solutions of `ts`. Throws Error, with what to call, where M or S is missing, S changes with
  // u, or a matrix does not fit; PetscFailure where a function of the user's fails.
  TsEquation(TS ts, const TsFormulation& formulation, Vec u, bool is_separable);

  // False where another matrix or Tao is composed with the TS by now, or a matrix has changed.
  bool is_current() const { return given_ == given_now(); }

  // In the coordinates z.
  Mat S() const { return S_; }
  Mat M() const { return M_; }
  Mat D() const { return D_; }  // null: none
  const std::shared_ptr<TsFunctions>& functions() const { return functions_; }
  bool is_separable() const { return is_separable_; }

  // From here on V is asked for at these momenta, so that one on which it depends after all shows: SupportGrew.
  void hold_momenta(const Vector& z) const;
  void to_state(Vec u, Vector& z) const;
  void to_solution(const Vector& z, Vec u) const;

 private:
  struct Given {  // PETSc counts its objects and the changes of each
    PetscObjectId id = 0;
    PetscObjectState state = 0;
    bool operator==(const Given&) const = default;
  };
  std::array<Given, 4> given_now() const;
  void find_positions(MPI_Comm communicator, const Vector& start);
  void find_structure(TS ts, const TsFormulation& formulation, const Vector& start);
  void take(Mat given, const char* name, Index rows, OwnedMat& taken) const;

  TS ts_;
  std::array<Given, 4> given_;
  std::shared_ptr<TsFunctions> functions_;
  bool is_separable_ = false;
  OwnedMat S_, M_, D_;
};

// The same on one process.
Problem problem_of(const TsEquation& equation, const Vector& initial);

}  // namespace seiche
