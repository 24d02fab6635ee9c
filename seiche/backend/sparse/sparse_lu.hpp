// LU of sparse matrices without structure, kept so that `solve` allocates nothing: Eigen's own solve asks for a work
// array every time.
#pragma once

#include <seiche/core/grid/sparse_operators.hpp>

#include <complex>
#include <vector>

namespace seiche {

template <class Scalar>
class SparseLu {
 public:
  using ScalarVector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  explicit SparseLu(const Eigen::SparseMatrix<Scalar>& a);  // throws Error where a is singular
  void solve(ScalarVector& x) const;                        // x ← A⁻¹x

 private:
  Eigen::SparseMatrix<Scalar> L_, U_;    // without their diagonals
  ScalarVector inverse_diagonal_;        // of U
  std::vector<int> row_of_, column_of_;  // where the permutations put unknown i
  mutable ScalarVector permuted_;
};

extern template class SparseLu<double>;
extern template class SparseLu<std::complex<double>>;

}  // namespace seiche
