// What block Lanczos iteration makes of one or two vectors.
#pragma once

#include <seiche/backend/krylov/product.hpp>
#include <seiche/core/space.hpp>

#include <Eigen/Dense>

namespace seiche {

// With V of M-orthonormal columns whose first few span the given vectors, W_start = V R:  SM ≈ V T Vᵀ M on them, T
// skew, and e^{hSM} W_start ≈ V e^{hT} R. V and the vectors in the part that this process holds; T, R and all that
// follows from them are the same on every process.
class KrylovSpace {
 public:
  KrylovSpace(const Product& S, const Product& M, const Space& space) : S_(S), M_(M), space_(space) {}  // outlive it

  // `start`: one or two columns. `blocks`: the dimension in blocks of as many; 0: until e^{hT}R settles. Throws Error
  // where it does not within a few hundred.
  void build(const Eigen::MatrixXd& start, double h, int blocks);

  // (e^{hT} − I) R, by which the given vectors change, and R itself.
  const Eigen::MatrixXd& change() const { return change_; }
  const Eigen::MatrixXd& coordinates() const { return R_; }
  void add(const Vector& coordinates, Vector& z) const { z.noalias() += V_.leftCols(coordinates.size()) * coordinates; }

 private:
  Index append(Eigen::MatrixXd& block, Eigen::MatrixXd& coefficients);
  double norm_in_M(Eigen::MatrixXd::ColXpr x);
  void reserve(Index columns, Index rows);
  void exponentiate(double h);
  [[noreturn]] void complain(double h) const;

  const Product &S_, &M_;
  const Space& space_;
  Eigen::MatrixXd V_, W_, T_, R_, change_;  // W = MV
  Index size_ = 0;                          // columns of V so far
  Vector Mx_;
};

}  // namespace seiche
