// The exponential propagator by block Lanczos iteration in the inner product of M, where S is skew and M ≻ 0: then SM
// is skew in it, and what the iteration computes is an isometry whatever its dimension.
#pragma once

#include <seiche/backend/krylov/product.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/core/propagator.hpp>

#include <memory>

namespace seiche {

// S and M by their products, and M⁻¹: the only equation to solve, which serves every h. All outlive it.
class SkewSystem {
 public:
  SkewSystem(const Product& of_S, const Product& of_M, const Space& of_states) : S(of_S), M(of_M), space(of_states) {}
  virtual ~SkewSystem() = default;
  SkewSystem(const SkewSystem&) = delete;
  SkewSystem& operator=(const SkewSystem&) = delete;

  const Product &S, &M;
  const Space& space;
  virtual void divide_by_M(Vector& f) const = 0;  // f ← M⁻¹f
};

// What whoever makes one throws where S is not skew, or M not definite, with what is known of it.
Error lanczos_needs_skew_S();
Error lanczos_needs_definite_M(const std::string& found);

// `powers` and `update` stand on one isometry of span{z, M⁻¹f} and what SM makes of it, so that the sav family keeps
// its energy law to round-off even at a small dimension, and where M⁻¹f is known to a tolerance only. The other verbs
// iterate until nothing changes: methods that call them one by one need the true exponential. With `moved`, of a
// Restoration, these keep the contract to round-off where M⁻¹f is known to a tolerance. Unlike other propagators it
// allocates, as much as its dimension turns out to need.
std::unique_ptr<Propagator> lanczos_propagator(std::shared_ptr<const SkewSystem> system, Potential::Support support,
                                               double h, int dimension, double* moved = nullptr);

}  // namespace seiche
