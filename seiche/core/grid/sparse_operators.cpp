#include <seiche/core/base/error.hpp>
#include <seiche/core/grid/sparse_operators.hpp>
#include <seiche/core/numerics/definiteness.hpp>
#include <seiche/core/text/number_text.hpp>

#include <cmath>

namespace seiche {
namespace {

void require_shape(const char* name, const SparseMatrix& a, Index size) {
  if (a.rows() != a.cols()) throw Error("{} is {} × {} and must be square", name, a.rows(), a.cols());
  if (a.rows() != size) throw Error("{} is {} × {} but M is {} × {}", name, a.rows(), a.cols(), size, size);
  for_entries(a, [name](Index i, Index j, double value) {
    if (!std::isfinite(value))
      throw Error("{} has the entry ({}, {}) = {}, which is not finite", name, i + 1, j + 1, number_text(value));
  });
}

void require_symmetric(const SparseMatrix& M) {
  for_entries(M, [&M](Index i, Index j, double value) {
    const double mirrored = M.coeff(j, i);
    if (std::abs(value - mirrored) > 4 * epsilon * std::abs(value))
      throw Error("M must be symmetric, but ({}, {}) = {} and ({}, {}) = {}", i + 1, j + 1, value, j + 1, i + 1,
                  mirrored);
  });
}

}  // namespace

bool SparseOperators::damping_moves(Index begin, Index size) const {
  bool moves = false;
  for_entries(D, [&](Index row, Index, double value) {
    if (value != 0 && row >= begin && row < begin + size) moves = true;
  });
  return moves;
}

void SparseOperators::validate() const {
  require_shape("M", M, M.rows());
  require_shape("S", S, M.rows());
  require_shape("D", D, M.rows());
  require_symmetric(M);
  if (const auto x = negative_direction(M))
    throw Error("M must be positive semidefinite, but zᵀMz = {:.6g} for a z of norm 1 that is largest at entry {}",
                x->value, x->largest + 1);
}

}  // namespace seiche
