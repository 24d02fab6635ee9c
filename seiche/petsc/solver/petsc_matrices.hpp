// Matrices that the processes of a communicator hold together, row by row, and vectors that are arrays of ours.
#pragma once

#include <seiche/backend/krylov/product.hpp>
#include <seiche/core/base/function_ref.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/petsc/solver/petsc_call.hpp>

#include <petscksp.h>

#include <complex>
#include <memory>

namespace seiche {

using OwnedVec = PetscHandle<Vec, VecDestroy>;
using OwnedMat = PetscHandle<Mat, MatDestroy>;

// A vector without an array of its own: while it lives, that of `values`.
class BorrowedVec {
 public:
  void set_layout(MPI_Comm communicator, Index local_size);
  Vec of(std::span<const double> values) const;  // stands for them until the next call

 private:
  OwnedVec vec_;
};

class PetscProduct final : public Product {
 public:
  explicit PetscProduct(Mat a);  // whose owner it becomes, beside others
  using Product::apply;
  void apply(std::span<const double> x, std::span<double> y) const override;

 private:
  OwnedMat a_;
  BorrowedVec x_, y_;
};

MPI_Comm communicator_of(Mat a);
Index local_rows(Mat a);
PetscInt first_row(Mat a);  // that is here
void multiply(Mat a, Mat b, OwnedMat& product);
void add(double factor, Mat b, Mat a);  // a += factor · b
// hB − p, or for a complex p the real matrix of twice the size: the two parts of each unknown side by side.
void make_shifted(Mat B, double h, std::complex<double> p, OwnedMat& shifted);
void make_symmetric_part(Mat a, OwnedMat& part);
void make_absolute(Mat a, OwnedMat& absolute);  // of every entry
bool is_zero(Mat a);
bool has_entries(Mat a, Potential::Support rows);  // of those that are here, counted from the first here
void visit_rows(Mat a,
                FunctionRef<void(Index row, std::span<const PetscInt> columns, std::span<const double> values)> visit);
double spectral_radius_bound(Mat a);  // as that of sparse matrices
Vector balancing_scales(Mat a);       // of rows that are here; powers of two
// Whether xᵀax ≥ margin ‖a‖ |x|² for every x but for round-off, 1e-12 ‖a‖, of a symmetric a: by the dominance of its
// diagonal, or by the inertia of its factors.
bool is_nonnegative(Mat a, double margin = 0);
SparseMatrix sparse_matrix(Mat a);  // of one process

inline std::span<const double> span_of(const Vector& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }
inline std::span<double> span_of(Vector& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }

}  // namespace seiche
