#include <seiche/backend/sparse/sparse_kernel.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/OrderingMethods>
#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseQR>

#include <algorithm>
#include <cmath>
#include <random>
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

double largest_column(const SparseMatrix& A) {
  double largest = 0;
  for (Index j = 0; j < A.cols(); ++j) largest = std::max(largest, A.col(j).norm());
  return largest;
}

// With AᵀP = QR of rank r, the columns of Q after the first r are orthogonal to the range of Aᵀ.
SparseMatrix kernel_by_qr(const SparseMatrix& A) {
  const Index n = A.cols();
  SparseMatrix transposed = A.transpose();
  transposed.makeCompressed();
  Eigen::SparseQR<SparseMatrix, Eigen::COLAMDOrdering<int>> qr;
  qr.setPivotThreshold(1e-12 * largest_column(transposed));
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

// At most, of AᵀA.
double entries_of_square(const SparseMatrix& A) {
  std::vector<double> in_row(static_cast<std::size_t>(A.rows()));
  for_entries(A, [&](Index i, Index, double) { ++in_row[static_cast<std::size_t>(i)]; });
  double sum = 0;
  for (const double count : in_row) sum += square(count);
  return sum;
}

// Of a random block, (AᵀA + δI)⁻¹ leaves the kernel and divides what belongs to σ by 1 + σ²/δ.
SparseMatrix kernel_by_inverse_iteration(const SparseMatrix& A) {
  constexpr int iterations = 6;
  const Index n = A.cols();
  const double size = largest_column(A);
  if (entries_of_square(A) > 64.0 * static_cast<double>(n)) return {n, 0};
  SparseMatrix shifted = A.transpose() * A;
  shifted += 1e-13 * square(size) * identity_matrix(n);
  const Eigen::SimplicialLDLT<SparseMatrix> factors(shifted);
  if (factors.info() != Eigen::Success) return {n, 0};
  for (Index tried = 4; tried <= 2 * most_of_large_kernel; tried *= 2) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    Eigen::MatrixXd block = Eigen::MatrixXd::NullaryExpr(n, tried, [&] { return normal(random); });
    for (int i = 0; i < iterations; ++i) {
      const Eigen::MatrixXd solved = factors.solve(block);
      block = Eigen::HouseholderQR<Eigen::MatrixXd>(solved).householderQ() * Eigen::MatrixXd::Identity(n, tried);
    }
    const Eigen::MatrixXd image = A * block;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(image.transpose() * image);
    const Index found = (ritz.eigenvalues().array() <= square(1e-9 * size)).count();
    if (found > most_of_large_kernel) break;
    if (found == tried) continue;
    if (ritz.eigenvalues()[found] < square(1e-5 * size)) break;  // no gap: what was found may be slow, and no kernel
    return Eigen::MatrixXd(block * ritz.eigenvectors().leftCols(found)).sparseView(1.0, epsilon / 4);
  }
  return {n, 0};
}

}  // namespace

SparseMatrix sparse_kernel(const SparseMatrix& A) {
  const Index n = A.cols();
  if (n > kernel_limit || is_permutation_of_diagonal(A)) return {n, 0};
  if (A.nonZeros() == 0) return identity_matrix(n);  // SparseQR finds no rank in nothing
  return n <= qr_limit ? kernel_by_qr(A) : kernel_by_inverse_iteration(A);
}

}  // namespace seiche
