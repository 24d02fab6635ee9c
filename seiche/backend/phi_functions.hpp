// φ-functions of a matrix: the whole system (dense) or one small block per mode.
#pragma once

#include <seiche/backend/force_map.hpp>
#include <seiche/core/phi.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace seiche {

// ‖Aᵏ‖^{1/k} instead of ‖A‖: wave systems have entries 1 and 1/Δx² but frequencies 1/Δx.
template <class Matrix>
double scaled_norm(const Matrix& A) {
  const Matrix A2 = A * A;
  return std::max(std::sqrt(force_map_detail::norm_1(A2)),
                  std::cbrt(force_map_detail::norm_1<Matrix>((A2 * A).eval())));
}

// phi[k] ← φ_k(A) for k = 0 … order, by Taylor's series of φ_order at A/2ʲ, the recurrence φ_k = Aφ_{k+1} + I/k! down
// from it, and j doublings: φ_k(2A) = 2^{−k} [φ₀(A)φ_k(A) + Σ_{l=1}^{k} φ_l(A)/(k−l)!]. No division by A anywhere.
template <class Matrix>
void phi_functions(const Matrix& A, Index order, std::vector<Matrix>& phi) {
  const Matrix I = Matrix::Identity(A.rows(), A.cols());
  const double size = scaled_norm(A);
  const int doublings = size > 0.5 ? static_cast<int>(std::ceil(std::log2(size / 0.5))) : 0;
  const Matrix small = std::ldexp(1.0, -doublings) * A;

  const auto count = static_cast<std::size_t>(order) + 1;
  phi.resize(count);
  double factorial = 1;  // of k
  for (Index k = 2; k <= order; ++k) factorial *= static_cast<double>(k);
  // Σ_i Aⁱ/(order + i)! up to i = 19, four powers at a time (Paterson and Stockmeyer): seven products instead of nineteen.
  constexpr Index groups = 5;
  const Matrix A2 = small * small;
  const Matrix A3 = A2 * small;
  const Matrix A4 = A2 * A2;
  std::array<double, 4 * groups> c{};
  c[0] = 1 / factorial;
  for (std::size_t i = 1; i < c.size(); ++i) c[i] = c[i - 1] / static_cast<double>(order + static_cast<Index>(i));
  Matrix sum = Matrix::Zero(A.rows(), A.cols());
  for (std::size_t i = c.size(); i > 0; i -= 4) {
    sum = (A4 * sum).eval();
    sum += c[i - 4] * I + c[i - 3] * small + c[i - 2] * A2 + c[i - 1] * A3;
  }
  phi[count - 1] = sum;
  for (Index k = order - 1; k >= 0; --k) {
    factorial /= static_cast<double>(k + 1);
    phi[static_cast<std::size_t>(k)] = small * phi[static_cast<std::size_t>(k) + 1] + I / factorial;
  }
  for (int j = 0; j < doublings; ++j) {
    for (Index k = order; k >= 0; --k) {  // downwards: φ_k needs the undoubled φ_l with l ≤ k only
      Matrix doubled = phi[0] * phi[static_cast<std::size_t>(k)];
      double inverse_factorial = 1;  // of (k − l)
      for (Index l = k; l >= 1; --l) {
        doubled += inverse_factorial * phi[static_cast<std::size_t>(l)];
        inverse_factorial /= static_cast<double>(k - l + 1);
      }
      phi[static_cast<std::size_t>(k)] = std::ldexp(1.0, -static_cast<int>(k)) * doubled;
    }
  }
}

// The matrices of one row: blocks[0] of z, then one for each force, with S folded into those of gradients.
template <class Matrix>
class PhiRowBlocks {
 public:
  PhiRowBlocks(const PhiRows& rows, const Matrix& L, const Matrix& S, double h) : rows_(rows), L_(L), S_(S), h_(h) {
    blocks_.resize(static_cast<std::size_t>(rows.forces) + 1);
  }

  const std::vector<Matrix>& of(const PhiRow& row) {
    phi_functions<Matrix>(row.theta * h_ * L_, rows_.order, phi_);
    blocks_[0] = rows_.of_state ? phi_[0] : Matrix::Zero(L_.rows(), L_.cols());
    for (Index j = 0; j < rows_.forces; ++j) {
      Matrix sum = Matrix::Zero(L_.rows(), L_.cols());
      for (Index k = 0; k < rows_.order; ++k)
        sum +=
            (h_ * row.weights[static_cast<std::size_t>(j * rows_.order + k)]) * phi_[static_cast<std::size_t>(k) + 1];
      if (rows_.kind == PhiRows::Forces::gradients) sum = (sum * S_).eval();
      blocks_[static_cast<std::size_t>(j) + 1] = sum;
    }
    return blocks_;
  }

 private:
  const PhiRows& rows_;
  const Matrix &L_, &S_;
  double h_;
  std::vector<Matrix> phi_, blocks_;
};

// Q of PhiForms: sym(MD) − M sym(S) M.
template <class Matrix>
Matrix dissipation_matrix(const Matrix& S, const Matrix& M, const Matrix& D) {
  const Matrix MD = M * D;
  return 0.5 * (MD + MD.adjoint()) - 0.5 * (M * (S + S.adjoint()) * M);
}

}  // namespace seiche
