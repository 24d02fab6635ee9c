// What block Lanczos iteration makes of one or two vectors.
#pragma once

#include <seiche/core/grid/sparse_operators.hpp>

#include <Eigen/Dense>

namespace seiche {

// With V of M-orthonormal columns whose first few span the given vectors, W_start = V R:  SM ≈ V T Vᵀ M on them, T
// skew, and e^{hSM} W_start ≈ V e^{hT} R.
class KrylovSpace {
 public:
  // `start`: one or two columns. `blocks`: the dimension in blocks of as many; 0: until e^{hT}R settles. Throws Error
  // where it does not within a few hundred.
  void build(const SparseMatrix& S, const SparseMatrix& M, const Eigen::MatrixXd& start, double h, int blocks);

  // (e^{hT} − I) R, by which the given vectors change, and R itself.
  const Eigen::MatrixXd& change() const { return change_; }
  const Eigen::MatrixXd& coordinates() const { return R_; }
  void add(const Vector& coordinates, Vector& z) const { z.noalias() += V_.leftCols(coordinates.size()) * coordinates; }

 private:
  Index append(const SparseMatrix& M, Eigen::MatrixXd& block, Eigen::MatrixXd& coefficients);
  void reserve(Index columns, Index rows);
  void exponentiate(double h);
  [[noreturn]] void complain(double h) const;

  Eigen::MatrixXd V_, W_, T_, R_, change_;  // W = MV
  Index size_ = 0;                          // columns of V so far
};

}  // namespace seiche
