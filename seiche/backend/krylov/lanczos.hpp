// The exponential propagator by block Lanczos iteration in the inner product of M, where S is skew and M ≻ 0: then SM
// is skew in it, and what the iteration computes is an isometry whatever its dimension.
#pragma once

#include <seiche/backend/krylov/sparse_ldlt.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/core/propagator.hpp>

#include <memory>

namespace seiche {

// S, M and M⁻¹: the only factorisation, which serves every h. Throws Error where S is not skew or M not definite.
class SkewSystem {
 public:
  SkewSystem(const SparseMatrix& S, const SparseMatrix& M);
  const SparseMatrix& S() const { return S_; }
  const SparseMatrix& M() const { return M_; }
  void divide_by_M(Vector& f) const { M_factors_->solve(f); }  // f ← M⁻¹f

 private:
  SparseMatrix S_, M_;
  std::unique_ptr<SparseLdlt<double>> M_factors_;
};

// `advance` stands on one isometry of span{z, M⁻¹f} and what SM makes of it, so that the sav family keeps its energy
// law to round-off even at a small dimension. The other verbs iterate until nothing changes: methods that call them one
// by one need the true exponential. Unlike other propagators it allocates, as much as its dimension turns out to need.
std::unique_ptr<Propagator> lanczos_propagator(std::shared_ptr<const SkewSystem> system, Potential::Support support,
                                               double h, int dimension);

}  // namespace seiche
