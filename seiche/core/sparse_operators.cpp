#include <seiche/core/sparse_operators.hpp>

namespace seiche {

bool SparseOperators::damping_moves(Index begin, Index size) const {
  for (Index column = 0; column < D.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(D, column); entry; ++entry)
      if (entry.value() != 0 && entry.row() >= begin && entry.row() < begin + size) return true;
  return false;
}

}  // namespace seiche
