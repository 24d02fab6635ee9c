// The points of a problem, divided among processes: places in whole vectors and in those of one process.
#pragma once

#include <seiche/core/grid/ranks.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/petsc/solver/petsc_matrices.hpp>

#include <memory>

namespace seiche {

// Each process holds whole units of points, of every field, one field after the other.
class DividedPoints {
 public:
  DividedPoints(Index fields, Index points, const Rank& here);

  const FieldPart& part() const { return part_; }  // of one field
  Index local_size() const { return fields_ * part_.size; }
  PetscInt row(Index component) const;     // PETSc's number of a component of whole vectors
  Vector here(const Vector& whole) const;  // what is here of one
  void make(const SparseMatrix& whole, MPI_Comm communicator, OwnedMat& matrix) const;

 private:
  FieldPart of(int rank) const;
  Index fields_, points_;
  Rank here_;
  Units units_;
  FieldPart part_;
};

// V of what each process holds. Where V adds up over points it is V of these, and where V tells its terms it is theirs
// (halo_potential); otherwise all values are gathered on every process, which computes the whole V. `ranks` outlives
// it.
std::shared_ptr<const PointwisePotential> divided_potential(std::shared_ptr<const PointwisePotential> whole,
                                                            const FieldPart& part, const Ranks& ranks);

}  // namespace seiche
