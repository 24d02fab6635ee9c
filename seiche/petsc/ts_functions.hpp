// V, its gradient and S by the functions that a TS was given.
#pragma once

#include <seiche/petsc/solver/petsc_matrices.hpp>

#include <petsctao.h>
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

// ∇V has an entry where it had none before: V depends on more components of u than was thought.
class SupportGrew : public std::exception {
 public:
  const char* what() const noexcept override {
    return "V depends on components of u that its gradient did not show near the start: say so by -ts_seiche_separable 0";
  }
};

// A Tao that is composed with the TS as "V" knows V and ∇V; without one V is F − ½uᵀMu by the formulation, and 0
// without a formulation. Every call is one of all processes of the TS, of which each gives the components that it
// holds.
class TsFunctions {
 public:
  // Throws Error where one of F and its gradient is missing. u: the layout of solutions.
  TsFunctions(TS ts, const TsFormulation& formulation, Mat M, Vec u);

  Vec layout() const { return u_; }
  bool has_V() const { return has_V_by_tao() || formulation_.F != nullptr; }
  // Component i of z is component order[i] of u, as both are held here; the first `support` of them are those that V
  // depends on.
  void use(std::vector<Index> order, Index support);
  std::span<const Index> order() const { return order_; }
  Index support() const { return support_; }

  // The components of z from `first` on; others stay what they were.
  void set(std::span<const double> z, Index first = 0) const;
  double value(std::span<const double> support) const;  // V, which all processes get
  // ∇V on the support. Throws SupportGrew, on all processes, where another component is not zero on one.
  void gradient(std::span<const double> support, std::span<double> out) const;
  void make_structure(OwnedMat& S) const;  // at the components that are set

 private:
  bool has_V_by_tao() const { return static_cast<Tao>(V_) != nullptr; }
  PetscReal time() const;

  TS ts_;
  TsFormulation formulation_;
  OwnedMat M_;
  PetscHandle<Tao, TaoDestroy> V_;
  bool is_alone_;
  OwnedVec u_, slope_, Mu_;
  std::vector<Index> order_;
  Index support_;
};

// What is composed with the TS under a name, or null. Throws Error, with `what` it should be, where it is something
// else.
template <class Object>
Object composed(TS ts, const char* name, PetscClassId kind, const char* what);

}  // namespace seiche
