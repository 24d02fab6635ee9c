// S, M and D of a problem whose coefficients change from point to point, or that lives on no grid at all.
#pragma once

#include <seiche/core/base/sparse_matrix.hpp>

namespace seiche {

// Square, of the size of z in physical coordinates, field after field. Contract: M symmetric.
struct SparseOperators {
  SparseMatrix S = {}, M = {}, D = {};  // D: the constant part of the damping

  bool damping_moves(Index begin, Index size) const;  // D has an entry in these rows

  // Throws Error, with the entries or the direction that show it, where a matrix is not square, has another size than
  // M, or holds a number that is not finite, and where M is not symmetric or M ⪰ 0 fails. An S that feeds is a problem
  // without a law.
  void validate() const;
};

}  // namespace seiche
