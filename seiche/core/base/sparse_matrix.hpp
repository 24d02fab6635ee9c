// Matrices of which only the entries that are not zero are stored, column after column.
#pragma once

#include <seiche/core/base/vector.hpp>

#include <Eigen/SparseCore>

namespace seiche {

using SparseMatrix = Eigen::SparseMatrix<double>;

inline SparseMatrix identity_matrix(Index size) {
  SparseMatrix i(size, size);
  i.setIdentity();
  return i;
}

// visit(row, column, value) for every stored entry, column after column.
template <class Visit>
void for_entries(const SparseMatrix& a, const Visit& visit) {
  for (Index column = 0; column < a.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(a, column); entry; ++entry) visit(entry.row(), column, entry.value());
}

}  // namespace seiche
