// The force map F of the linear substep z⁺ = Ez + Ff by diagonal Padé approximation, in product form.
#pragma once

#include <seiche/backend/krylov/product.hpp>
#include <seiche/backend/sparse/pade_poles.hpp>
#include <seiche/backend/sparse/resolvent.hpp>

#include <memory>
#include <vector>

namespace seiche {

// y = F c for F ≈ hφ₁(hSM)S, where every factor (A + p)(A − p)⁻¹ of r(A), A = hSM, is a map y ↦ r y + (…)c of its own
// that keeps the contract F + Fᵀ + FᵀMF = 0 (⪯ 0) to round-off, whatever q: accuracy is a matter of q, the energy law
// is not. With partial fractions instead the contract would lose a digit per degree.
class PadeForce {
 public:
  // S and M outlive it; `size`: of the part of a vector that is here.
  PadeForce(const Product& S, const Product& M, Index size, const Resolvents& resolvents, double h, PadePlan plan);
  void apply(const Vector& c, Vector& y) const;  // y = F c; y must not be c

 private:
  struct Factor {
    std::complex<double> pole;
    std::unique_ptr<Resolvent> resolvent;
  };
  const Product& S_;
  const Product& M_;
  double h_;  // of one part
  int steps_;
  std::vector<Factor> factors_;
  mutable Vector slope_, rate_, x_;  // scratch
};

// A bound of the spectral radius: the least of ‖Bᵏ‖^{1/k} in the norm of columns, k = 1, 2, 3.
double spectral_radius_bound(const SparseMatrix& B);

}  // namespace seiche
