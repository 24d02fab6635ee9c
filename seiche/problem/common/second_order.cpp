#include <seiche/core/base/error.hpp>
#include <seiche/problem/common/second_order.hpp>

#include <limits>

namespace seiche {
namespace {

void add_block(std::vector<Entry>& entries, const SparseMatrix& a, Index row, Index column, double factor) {
  for (Index j = 0; j < a.outerSize(); ++j)
    for (SparseMatrix::InnerIterator entry(a, j); entry; ++entry)
      entries.push_back({row + entry.row(), column + j, factor * entry.value()});
}

}  // namespace

SparseMatrix assembled(Index n, const std::vector<Entry>& entries) {
  constexpr std::size_t most = std::numeric_limits<int>::max();  // a SparseMatrix counts them by int
  if (entries.size() > most)
    throw Error("a sparse matrix of {} entries is not possible: at most {}; choose fewer points", entries.size(), most);
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(entries.size());
  for (const Entry& e : entries) triplets.emplace_back(static_cast<int>(e.row), static_cast<int>(e.column), e.value);
  SparseMatrix a(n, n);
  a.setFromTriplets(triplets.begin(), triplets.end());
  return a;
}

Problem second_order_problem(std::string name, const Grid& grid, const SparseMatrix& stiffness, const Masses& masses) {
  Problem p;
  p.name = std::move(name);
  p.grid = grid;
  p.fields = masses.fields;
  p.S = p.M = BlockStencil(p.field_count());
  p.damping.constant = BlockStencil(p.field_count());
  const Index n = stiffness.rows();
  std::vector<Entry> S, M, D;
  add_block(M, stiffness, 0, 0, 1);
  for (Index i = 0; i < n; ++i) {
    S.push_back({i, n + i, 1});
    S.push_back({n + i, i, -1});
    M.push_back({n + i, n + i, masses.inverse_mass});
  }
  add_block(D, masses.dashpots, n, n, masses.inverse_mass);
  p.matrices = std::make_shared<SparseOperators>(
      SparseOperators{.S = assembled(2 * n, S), .M = assembled(2 * n, M), .D = assembled(2 * n, D)});
  p.initial = Vector::Zero(2 * n);
  return p;
}

Grid points_without_place(Index count) {
  return {.axes = {{count, static_cast<double>(count), Boundary::periodic}}, .only_numbers = true};
}

}  // namespace seiche
