// Resolvents by PETSc's linear solvers, on as many processes as hold the matrix.
#pragma once

#include <seiche/backend/sparse/resolvent.hpp>
#include <seiche/petsc/petsc_matrices.hpp>

#include <cstdint>
#include <memory>
#include <string>

namespace seiche {

// (A − p)⁻¹ for A = hB, with a complex p as a real system of twice the size,
//   (A − a)x + by = r,  (A − a)y − bx = 0,  p = a + ib:   y/b = Im((A − p)⁻¹r)/b.
// By LU factors, those of one process by PETSc's own, of several by MUMPS; unless options with the prefix of the TS and
// `seiche_` say otherwise (-seiche_ksp_type gmres, -seiche_pc_type ilu …; a preconditioner alone goes with GMRES).
// Throws Error where the options ask for a preconditioner and no iteration, and where a solver does not converge.
class KspResolvents final : public Resolvents {
 public:
  enum class Tolerance { of_options, round_off };  // of an iteration
  KspResolvents(Mat B, std::string prefix, Tolerance tolerance = Tolerance::of_options)
      : prefix_(std::move(prefix)), tolerance_(tolerance) {
    B_.share(B);
  }
  std::unique_ptr<Resolvent> make(double h, std::complex<double> pole) const override;
  bool iterates() const;  // by the options: results hold to a tolerance only
  std::int64_t iterations() const { return iterations_; }

 private:
  OwnedMat B_;
  std::string prefix_;
  Tolerance tolerance_;
  mutable std::int64_t iterations_ = 0;
};

}  // namespace seiche
