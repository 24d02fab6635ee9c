// Resolvents by PETSc's linear solvers, on as many processes as hold the matrix.
#pragma once

#include <seiche/backend/sparse/resolvent.hpp>
#include <seiche/petsc/petsc_matrices.hpp>

#include <cstdint>
#include <memory>

namespace seiche {

// (A − p)⁻¹ for A = hB, with a complex p as a real system of twice the size,
//   (A − a)x + by = r,  (A − a)y − bx = 0,  p = a + ib:   y/b = Im((A − p)⁻¹r)/b.
// By LU factors unless the options with the prefix -seiche_ say otherwise (-seiche_ksp_type gmres …): those of one
// process by PETSc's own, of several by MUMPS. Applying one throws Error where the solver does not converge.
class KspResolvents final : public Resolvents {
 public:
  explicit KspResolvents(Mat B) : B_(B) {}  // which outlives it
  std::unique_ptr<Resolvent> make(double h, std::complex<double> pole) const override;
  bool iterates() const;  // by the options: results hold to a tolerance only
  std::int64_t iterations() const { return iterations_; }

 private:
  Mat B_;
  mutable std::int64_t iterations_ = 0;
};

}  // namespace seiche
