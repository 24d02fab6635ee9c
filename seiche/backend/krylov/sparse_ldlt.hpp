// LDLᵀ of sparse matrices that are symmetric, real or complex: without conjugates, which Eigen's LDLᴴ would put in.
#pragma once

#include <seiche/core/grid/sparse_operators.hpp>

#include <complex>
#include <memory>
#include <vector>

namespace seiche {

// Fill-reducing order and pattern of L, which all matrices with the same places of entries share.
struct LdltPattern {
  explicit LdltPattern(const SparseMatrix& a);  // a: symmetric in its places of entries, every diagonal entry stored

  std::vector<int> position;    // of each unknown in the order of elimination
  std::vector<int> begin, row;  // upper triangle in that order, by columns …
  std::vector<int> from;        // … and where in the values of a its entries are
  std::vector<int> parent;      // elimination tree
  std::vector<int> L_row;       // rows of L, by columns
  std::vector<std::ptrdiff_t> L_begin;
};

// Up-looking, without pivots: for a + ib with a or a multiple of it by a phase positive definite nothing grows much.
// `solve` allocates nothing.
template <class Scalar>
class SparseLdlt {
 public:
  // `values` are those of a matrix with the places of entries that `pattern` was made from. Throws Error at a pivot 0.
  SparseLdlt(std::shared_ptr<const LdltPattern> pattern, const Scalar* values);
  void solve(Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& x) const;  // x ← A⁻¹x

 private:
  std::shared_ptr<const LdltPattern> pattern_;
  std::vector<Scalar> L_, inverse_D_;
  mutable Eigen::Matrix<Scalar, Eigen::Dynamic, 1> permuted_;
};

extern template class SparseLdlt<double>;
extern template class SparseLdlt<std::complex<double>>;

}  // namespace seiche
