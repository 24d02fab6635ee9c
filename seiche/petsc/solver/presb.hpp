// A preconditioner for resolvents with a complex pole in real numbers.
#pragma once

#include <seiche/petsc/solver/petsc_matrices.hpp>
#include <seiche/petsc/solver/solver_options.hpp>

#include <petscksp.h>

#include <complex>

namespace seiche {

// For (hB − p)(x + iy) = r, p = a + ib with a > 0, as the real system of KspResolvents: with W = a − hB
//   −K = [W, −b; b, W]  is preconditioned by  P = [W, −b; b, W + 2b],  b > 0,
// whose solution takes two with H = W + b (Axelsson, Neytcheva, Ahmad, Numer. Algorithms 66 (2014) 811): H(x + y) =
// f + g, Hx = f + b(x + y). For W + Wᵀ ⪰ 0 iterations do not grow with h. H, real and of the size of B, is left to a
// preconditioner of its own, with the options `presb_ksp_…` and `presb_pc_…`; of the first `first` components in a
// block of their own (0: of none) it is their Schur complement, by algebraic multigrid. For a real pole, b = 0, H = W.
class Presb {
 public:
  Presb(Mat B, double h, std::complex<double> p, Index first, const SolverOptions& options);
  void attach(PC pc);  // which it has to outlive

 private:
  static PetscErrorCode apply_to(PC pc, Vec r, Vec z);
  void apply(Vec r, Vec z) const;
  void solve(const Vector& right, Vector& x) const;  // Hx = right
  void split_fields(PC pc, Index rows, Index first) const;

  double b_;
  OwnedMat H_;
  PetscHandle<KSP, KSPDestroy> ksp_;
  BorrowedVec right_of_, solution_;
  mutable Vector right_, sum_, x_;
};

}  // namespace seiche
