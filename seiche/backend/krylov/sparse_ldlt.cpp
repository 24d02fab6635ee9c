#include <seiche/backend/krylov/sparse_ldlt.hpp>
#include <seiche/core/base/error.hpp>

#include <Eigen/OrderingMethods>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

double product(double a, double b) { return a * b; }

// Without the tests for infinities that the language asks of complex products.
std::complex<double> product(const std::complex<double>& a, const std::complex<double>& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

std::size_t at(int i) { return static_cast<std::size_t>(i); }

std::vector<int> elimination_order(const SparseMatrix& a) {
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(a, order);
  std::vector<int> position(at(static_cast<int>(a.rows())));
  for (int k = 0; k < static_cast<int>(position.size()); ++k) position[at(order.indices()[k])] = k;
  return position;
}

}  // namespace

// After T. A. Davis, Direct Methods for Sparse Linear Systems (2006), chapter 4.
LdltPattern::LdltPattern(const SparseMatrix& a) : position(elimination_order(a)) {
  const int n = static_cast<int>(a.rows());
  const auto for_upper = [&](const auto& visit) {
    for (int j = 0; j < n; ++j)
      for (int p = a.outerIndexPtr()[j]; p < a.outerIndexPtr()[j + 1]; ++p) {
        const int i = a.innerIndexPtr()[p];
        if (position[at(i)] <= position[at(j)]) visit(position[at(i)], position[at(j)], p);
      }
  };
  begin.assign(at(n) + 1, 0);
  for_upper([&](int, int column, int) { ++begin[at(column) + 1]; });
  for (int k = 0; k < n; ++k) begin[at(k) + 1] += begin[at(k)];
  row.resize(at(begin[at(n)]));
  from.resize(row.size());
  std::vector<int> next(begin.begin(), begin.end() - 1);
  for_upper([&](int i, int column, int p) {
    row[at(next[at(column)])] = i;
    from[at(next[at(column)]++)] = p;
  });

  // Row k of L has entries along the paths in the elimination tree from the entries of column k up to k.
  parent.assign(at(n), -1);
  std::vector<int> seen(at(n), -1);
  const auto for_row_of_L = [&](int k, const auto& visit) {
    seen[at(k)] = k;
    for (int p = begin[at(k)]; p < begin[at(k) + 1]; ++p)
      for (int i = row[at(p)]; seen[at(i)] != k; i = parent[at(i)]) {
        if (parent[at(i)] < 0) parent[at(i)] = k;
        visit(i);
        seen[at(i)] = k;
      }
  };
  L_begin.assign(at(n) + 1, 0);
  for (int k = 0; k < n; ++k) for_row_of_L(k, [&](int i) { ++L_begin[at(i) + 1]; });
  for (int k = 0; k < n; ++k) L_begin[at(k) + 1] += L_begin[at(k)];
  L_row.resize(static_cast<std::size_t>(L_begin[at(n)]));
  std::vector<std::ptrdiff_t> end(L_begin.begin(), L_begin.end() - 1);
  std::fill(seen.begin(), seen.end(), -1);
  for (int k = 0; k < n; ++k) for_row_of_L(k, [&](int i) { L_row[static_cast<std::size_t>(end[at(i)]++)] = k; });
}

template <class Scalar>
SparseLdlt<Scalar>::SparseLdlt(std::shared_ptr<const LdltPattern> pattern, const Scalar* values)
    : pattern_(std::move(pattern)), L_(pattern_->L_row.size()), inverse_D_(pattern_->position.size()) {
  const LdltPattern& p = *pattern_;
  const int n = static_cast<int>(p.position.size());
  permuted_.resize(n);
  std::vector<Scalar> y(at(n), Scalar(0));
  std::vector<int> path(at(n)), stack(at(n)), seen(at(n), -1);
  std::vector<std::ptrdiff_t> end(p.L_begin.begin(), p.L_begin.end() - 1);
  for (int k = 0; k < n; ++k) {
    int top = n;
    seen[at(k)] = k;
    for (int s = p.begin[at(k)]; s < p.begin[at(k) + 1]; ++s) {
      y[at(p.row[at(s)])] += values[p.from[at(s)]];
      int length = 0;
      for (int i = p.row[at(s)]; seen[at(i)] != k; i = p.parent[at(i)]) {
        path[at(length++)] = i;
        seen[at(i)] = k;
      }
      while (length > 0) stack[at(--top)] = path[at(--length)];
    }
    Scalar d = y[at(k)];
    y[at(k)] = 0;
    for (; top < n; ++top) {
      const int i = stack[at(top)];
      const Scalar y_i = y[at(i)];
      y[at(i)] = 0;
      const std::ptrdiff_t last = end[at(i)]++;
      for (std::ptrdiff_t q = p.L_begin[at(i)]; q < last; ++q) {
        const auto e = static_cast<std::size_t>(q);
        y[at(p.L_row[e])] -= product(L_[e], y_i);
      }
      const Scalar l = product(y_i, inverse_D_[at(i)]);
      d -= product(l, y_i);
      L_[static_cast<std::size_t>(last)] = l;
    }
    if (!(std::abs(d) > 0) || !std::isfinite(std::abs(d)))
      throw Error("a sparse symmetric matrix of {} unknowns has the pivot {} and cannot be factorised", n, std::abs(d));
    inverse_D_[at(k)] = Scalar(1) / d;
  }
}

template <class Scalar>
void SparseLdlt<Scalar>::solve(Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& x) const {
  const LdltPattern& p = *pattern_;
  const int n = static_cast<int>(p.position.size());
  for (int i = 0; i < n; ++i) permuted_[p.position[at(i)]] = x[i];
  for (int k = 0; k < n; ++k) {
    const Scalar y = permuted_[k];
    for (std::ptrdiff_t q = p.L_begin[at(k)]; q < p.L_begin[at(k) + 1]; ++q) {
      const auto e = static_cast<std::size_t>(q);
      permuted_[p.L_row[e]] -= product(L_[e], y);
    }
  }
  for (int k = n; k-- > 0;) {
    Scalar y = product(permuted_[k], inverse_D_[at(k)]);
    for (std::ptrdiff_t q = p.L_begin[at(k)]; q < p.L_begin[at(k) + 1]; ++q) {
      const auto e = static_cast<std::size_t>(q);
      y -= product(L_[e], permuted_[p.L_row[e]]);
    }
    permuted_[k] = y;
  }
  for (int i = 0; i < n; ++i) x[i] = permuted_[p.position[at(i)]];
}

template class SparseLdlt<double>;
template class SparseLdlt<std::complex<double>>;

}  // namespace seiche
