#include <seiche/backend/sparse_kernel.hpp>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseQR>

#include <algorithm>
#include <cmath>
#include <vector>

namespace seiche {
namespace {

bool is_permutation_of_diagonal(const SparseMatrix& A) {
  std::vector<int> in_row(static_cast<std::size_t>(A.rows()));
  std::vector<int> in_column(static_cast<std::size_t>(A.cols()));
  for_entries(A, [&](Index i, Index j, double value) {
    if (value == 0) return;
    ++in_row[static_cast<std::size_t>(i)];
    ++in_column[static_cast<std::size_t>(j)];
  });
  const auto is_one = [](int count) { return count == 1; };
  return std::all_of(in_row.begin(), in_row.end(), is_one) && std::all_of(in_column.begin(), in_column.end(), is_one);
}

}  // namespace

// With AᵀP = QR of rank r, the columns of Q after the first r are orthogonal to the range of Aᵀ.
SparseMatrix sparse_kernel(const SparseMatrix& A) {
  const Index n = A.cols();
  if (n > kernel_limit || is_permutation_of_diagonal(A)) return {n, 0};
  if (A.nonZeros() == 0) {  // SparseQR finds no rank in nothing
    SparseMatrix everything(n, n);
    everything.setIdentity();
    return everything;
  }
  SparseMatrix transposed = A.transpose();
  transposed.makeCompressed();
  double largest = 0;
  for (Index j = 0; j < n; ++j) largest = std::max(largest, transposed.col(j).norm());
  Eigen::SparseQR<SparseMatrix, Eigen::COLAMDOrdering<int>> qr;
  qr.setPivotThreshold(1e-12 * largest);
  qr.compute(transposed);
  SparseMatrix kernel(n, n - qr.rank());
  for (Index j = 0; j < kernel.cols(); ++j) {
    const Vector unit = Vector::Unit(n, qr.rank() + j);
    const Vector column = qr.matrixQ() * unit;
    for (Index i = 0; i < n; ++i)
      if (std::abs(column[i]) > epsilon / 4) kernel.insert(i, j) = column[i];
  }
  kernel.makeCompressed();
  return kernel;
}

}  // namespace seiche
