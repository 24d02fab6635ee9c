// Resolvents by PETSc's linear solvers, on as many processes as hold the matrix.
#pragma once

#include <seiche/backend/sparse/resolvent.hpp>
#include <seiche/petsc/solver/petsc_matrices.hpp>
#include <seiche/petsc/solver/solver_options.hpp>

#include <cstdint>
#include <memory>

namespace seiche {

// (A − p)⁻¹ for A = hB, with a complex p as a real system of twice the size,
//   (A − a)x + by = r,  (A − a)y − bx = 0,  p = a + ib:   y/b = Im((A − p)⁻¹r)/b.
// By LU factors, those of one process by PETSc's own, of several by MUMPS; unless options say otherwise (-ksp_type
// gmres, -pc_type ilu, -presb for the preconditioner Presb …; a preconditioner alone goes with GMRES). Throws Error
// where the options ask for a preconditioner and no iteration, and where a solver does not converge.
class KspResolvents final : public Resolvents {
 public:
  enum class Tolerance { of_options, round_off };  // of an iteration
  // `first`: so many components of those that are here are a block of their own, for Presb; 0: of none.
  KspResolvents(Mat B, SolverOptions options, Index first, Tolerance tolerance = Tolerance::of_options)
      : options_(std::move(options)), first_(first), tolerance_(tolerance) {
    B_.share(B);
  }
  std::unique_ptr<Resolvent> make(double h, std::complex<double> pole) const override;
  // By the options: results hold to a tolerance only. Throws Error where a factorisation is left with unknown options.
  bool iterates() const;
  std::int64_t iterations() const { return iterations_; }

 private:
  OwnedMat B_;
  SolverOptions options_;
  Index first_;
  Tolerance tolerance_;
  mutable std::int64_t iterations_ = 0;
};

}  // namespace seiche
