#include <seiche/backend/sparse/sparse_lu.hpp>
#include <seiche/core/base/error.hpp>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseLU>

#include <algorithm>
#include <limits>

namespace seiche {

template <class Scalar>
SparseLu<Scalar>::SparseLu(const Eigen::SparseMatrix<Scalar>& a) {
  using Matrix = Eigen::SparseMatrix<Scalar>;
  Eigen::SparseLU<Matrix, Eigen::COLAMDOrdering<int>> lu;
  lu.compute(a);
  if (lu.info() != Eigen::Success)
    throw Error("a sparse matrix of {} unknowns cannot be factorised: {}", a.rows(), lu.lastErrorMessage());
  const int n = static_cast<int>(a.rows());
  // Supernodes hold L below the diagonal, and the U of their diagonal blocks on and above it; the rest of U is apart.
  const auto upper = lu.matrixU();
  using Blocks = std::decay_t<decltype(upper.m_mapL)>;
  using Rest = std::decay_t<decltype(upper.m_mapU)>;
  std::vector<Eigen::Triplet<Scalar>> below, above;
  inverse_diagonal_.resize(n);
  for (int j = 0; j < n; ++j) {
    for (typename Blocks::InnerIterator entry(upper.m_mapL, j); entry; ++entry) {
      const int i = static_cast<int>(entry.row());
      if (i == j) {
        inverse_diagonal_[j] = Scalar(1) / entry.value();
      } else if (entry.value() != Scalar(0)) {
        (i > j ? below : above).emplace_back(i, j, entry.value());
      }
    }
    for (typename Rest::InnerIterator entry(upper.m_mapU, j); entry; ++entry)
      if (entry.value() != Scalar(0)) above.emplace_back(static_cast<int>(entry.row()), j, entry.value());
  }
  constexpr std::size_t most = std::numeric_limits<int>::max();  // a SparseMatrix counts them by int
  if (std::max(below.size(), above.size()) > most)
    throw Error(
        "the LU factors of a sparse matrix of {} unknowns have {} entries, and at most {} are possible; choose "
        "fewer points, or exponential = \"lanczos\"",
        n, std::max(below.size(), above.size()), most);
  L_.resize(n, n);
  U_.resize(n, n);
  L_.setFromTriplets(below.begin(), below.end());
  U_.setFromTriplets(above.begin(), above.end());
  const auto& rows = lu.rowsPermutation().indices();
  const auto& columns = lu.colsPermutation().indices();
  row_of_.assign(rows.begin(), rows.end());
  column_of_.assign(columns.begin(), columns.end());
  permuted_.resize(n);
}

template <class Scalar>
void SparseLu<Scalar>::solve(ScalarVector& x) const {
  using Column = typename Eigen::SparseMatrix<Scalar>::InnerIterator;
  const Index n = x.size();
  for (Index i = 0; i < n; ++i) permuted_[row_of_[static_cast<std::size_t>(i)]] = x[i];
  for (Index j = 0; j < n; ++j)
    for (Column entry(L_, j); entry; ++entry) permuted_[entry.row()] -= entry.value() * permuted_[j];
  for (Index j = n; j-- > 0;) {
    permuted_[j] *= inverse_diagonal_[j];
    for (Column entry(U_, j); entry; ++entry) permuted_[entry.row()] -= entry.value() * permuted_[j];
  }
  for (Index i = 0; i < n; ++i) x[i] = permuted_[column_of_[static_cast<std::size_t>(i)]];
}

template class SparseLu<double>;
template class SparseLu<std::complex<double>>;

}  // namespace seiche
