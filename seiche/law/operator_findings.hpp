// What the energy laws ask of S, M and D, looked at once: mode by mode on grids, by factorisation where there are
// matrices.
#pragma once

#include <seiche/core/grid/ranks.hpp>
#include <seiche/core/numerics/definiteness.hpp>
#include <seiche/core/problem.hpp>

#include <limits>
#include <optional>

namespace seiche {

// The smallest eigenvalue of a Hermitian symbol over all modes, and whose it is.
struct SmallestEigenvalue {
  double value = std::numeric_limits<double>::infinity();
  double size = 0.0;        // the largest entry of the symbol
  Mode mode = {};           // of the smallest eigenvalue
  Eigen::VectorXcd vector;  // its eigenvector, over the fields
  Index zeros = 0;          // eigenvalues that vanish
  Mode first_zero = {};

  bool is_nonnegative() const;  // to round-off of the size
};

// The evidence that a symmetric matrix is, or is not, positive semidefinite: of the two, the one that fits the problem.
struct Semidefiniteness {
  std::optional<SmallestEigenvalue> over_modes = std::nullopt;         // on grids
  std::optional<NegativeDirection> negative_direction = std::nullopt;  // of matrices, where there is one

  bool holds() const { return over_modes ? over_modes->is_nonnegative() : !negative_direction; }
};

struct OperatorFindings {
  Semidefiniteness M;
  Semidefiniteness minus_S;  // −½(S + Sᵀ)
  bool S_is_skew = false;    // S + Sᵀ = 0 exactly
  // Of ½(MD + DᵀM), for the constant part of D and for the projector of its rate; nothing where there is no such part.
  // A rate that is constant and commutes with that part is looked at as a piece of it.
  std::optional<Semidefiniteness> MD_constant, MD_rate;
};

// One pass over the modes of a grid; closed forms for one and two fields. Throws Error where a matrix cannot be
// factorised. Of several processes each looks at the modes that it holds, and all find the same; null: this one looks
// at all modes.
OperatorFindings look_at_operators(const Problem& problem, const Ranks* ranks = nullptr);

}  // namespace seiche
