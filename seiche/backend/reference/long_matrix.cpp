#include <seiche/backend/reference/long_matrix.hpp>
#include <seiche/core/base/error.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seiche {

int reference_halvings(const LongMatrix& A) {
  constexpr long double most = 1e8;  // every doubling doubles round-off
  const long double size = A.cwiseAbs().colwise().sum().maxCoeff();
  if (!(size <= most))
    throw Error(
        "the reference backend takes exponentials of matrices up to ‖hL‖ = {:.0e}, and here it is {:.3g}: take a smaller h, "
        "or backend \"dense\"",
        static_cast<double>(most), static_cast<double>(size));
  return size > 2 ? static_cast<int>(std::ceil(std::log2(size))) - 1 : 0;
}

std::vector<LongMatrix> reference_phi_functions(const LongMatrix& A, Index order) {
  const int halvings = reference_halvings(A);
  const Eigen::SparseMatrix<long double> small = (std::ldexp(1.0L, -halvings) * A).eval().sparseView();
  constexpr int terms = 27;  // 2²⁷/27! is below the round-off of long double
  const auto count = static_cast<std::size_t>(std::max<Index>(order, 1)) + 1;
  std::vector<long double> over_factorial = {1};  // 1/k!
  while (over_factorial.size() <= count + terms)
    over_factorial.push_back(over_factorial.back() / static_cast<long double>(over_factorial.size()));
  const auto times_small_plus = [&](const LongMatrix& from, std::size_t k) -> LongMatrix {  // … + I/k!
    LongMatrix product = from * small;
    product.diagonal().array() += over_factorial[k];
    return product;
  };

  std::vector<LongMatrix> phi(count, LongMatrix::Zero(A.rows(), A.cols()));
  for (std::size_t j = terms; j-- > 0;) phi[count - 1] = times_small_plus(phi[count - 1], count - 1 + j);
  for (std::size_t k = count - 1; k-- > 1;) phi[k] = times_small_plus(phi[k + 1], k);
  phi[0] = phi[1] * small;
  for (int i = 0; i < halvings; ++i) {
    for (std::size_t k = count - 1; k >= 1; --k) {  // φ_k(2A) asks for φ_l(A) with l ≤ k
      LongMatrix sum = phi[k] + phi[0] * phi[k];
      for (std::size_t l = 1; l <= k; ++l) sum += over_factorial[k - l] * phi[l];
      phi[k] = std::ldexp(1.0L, -static_cast<int>(k)) * sum;
    }
    phi[0] = (2 * phi[0] + phi[0] * phi[0]).eval();
  }
  return phi;
}

}  // namespace seiche
