// φ-functions by trajectories, where no exponential is kept: products with the matrices are all they take.
#pragma once

#include <seiche/backend/krylov/krylov_trajectory.hpp>
#include <seiche/core/phi.hpp>

#include <algorithm>
#include <memory>

namespace seiche {

// Krylov substeps of one exponential of hL, for the spectral radius ρ of L: each reaches about as far as its dimension
// lets it.
inline double krylov_substeps(double h_rho) { return std::max(1.0, h_rho / 10); }
inline constexpr double most_krylov_substeps = 1e6;

// S, M, L = SM − D₀ and Q = sym(MD₀) − M sym(S) M by their products.
class KrylovOperators {
 public:
  explicit KrylovOperators(const Space& of_states) : space(of_states) {}
  virtual ~KrylovOperators() = default;
  KrylovOperators(const KrylovOperators&) = delete;
  KrylovOperators& operator=(const KrylovOperators&) = delete;

  const Space& space;          // outlives them
  Potential::Support support;  // the components that V depends on
  std::shared_ptr<const Product> S, M;
  std::shared_ptr<const Product> L;  // in balanced coordinates u_i/d_i
  std::shared_ptr<const Product>
      S_support;        // S times what vanishes outside the support, whose components it takes; likewise
  Vector scales;        // d
  double rate = 0.0;    // a bound of the spectral radius of L
  bool holds_s = true;  // of KrylovTrajectory

  virtual const Product& Q() const = 0;
  virtual PhiEvaluator::Dissipation dissipation() const = 0;
  virtual bool without_casimirs(const Vector& z, Vector& d) const = 0;  // of PhiEvaluator
};

// Rows that lie on one trajectory cost one Krylov pass together, to about round-off. All maps of an evaluator work in
// the same memory, up to 31 vectors: no two of them run at a time.
std::unique_ptr<PhiEvaluator> krylov_phi(std::shared_ptr<const KrylovOperators> operators);

}  // namespace seiche
