// Solutions of sparse linear equations with polynomial forcing, by Arnoldi iteration.
#pragma once

#include <seiche/backend/krylov/hessenberg_flow.hpp>
#include <seiche/backend/krylov/product.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/core/space.hpp>

#include <cmath>
#include <memory>
#include <span>
#include <vector>

namespace seiche {

// u' = xLu + Σ_{k<p} B_k σᵏ/k! is the first part of w' = Aw with w = (u, s), s_k = σᵏ/k! and the augmented A = [xL, B;
// 0, J]. One pass from σ = 0 to the last σ asked for: the Krylov space of w grows until the estimate of HessenbergFlow
// is round-off, or to its largest dimension, and the substep ends where the estimate no longer is (Niesen & Wright
// 2012, phipm; Gaudreault, Rainwater & Tokman 2018, KIOPS). One thread at a time.
class KrylovTrajectory {
 public:
  // L in balanced coordinates u_i/d_i, with d in `scales`; `space` adds up what other processes hold of a vector, and
  // outlives it. s is the same on all of them, and counts on the one that holds it.
  KrylovTrajectory(std::shared_ptr<const Product> balanced_L, Vector scales, const Space& space, bool holds_s = true);

  // `forces`: the most p of later calls. Allocates all that they need, but a basis touches memory as it grows only.
  void reserve(Index forces, std::size_t outputs);

  const Vector& scales() const { return scales_; }

  struct Output {
    double sigma;  // > 0
    Vector* value;
  };
  // u(0) = z, or 0 without; B: unknowns × p in balanced coordinates; outputs: with increasing σ. Writes the components
  // in `range` of each value, all NaN where something is not finite.
  void integrate(double x, const Vector* z, const Eigen::MatrixXd& B, std::span<const Output> outputs,
                 Potential::Support range);

 private:
  struct Equation {
    double x;
    const Eigen::MatrixXd& B;
    double unit;  // the tail of w is held as unit · s, so that the norm of B/unit is about one; 0: B = 0
  };
  struct Walk {
    double length = 0;        // of σ
    std::size_t outputs = 0;  // on the way
  };
  Index unknowns() const { return scales_.size(); }  // here
  Index counted() const { return holds_s_ ? rows_ : unknowns(); }
  template <class W>
  double norm(const W& w) const {
    return std::sqrt(space_.sum(w.head(counted()).squaredNorm()));
  }
  double begin(const Equation& equation, double sigma);
  double append(const Equation& equation);
  Walk walk(double length, double sigma, std::span<const Output> ahead, double piece, double tolerance);
  Walk substep(const Equation& equation, double sigma, std::span<const Output> ahead);
  void write(const Vector& coordinates, double norm, Potential::Support range, Vector& value) const;

  std::shared_ptr<const Product> L_;
  Vector scales_;
  const Space& space_;
  bool holds_s_;
  Index unknowns_of_all_;
  HessenbergFlow flow_;
  Eigen::MatrixXd V_;           // the basis, in the first rows_
  Index rows_ = 0;              // of the equation at hand: one more for each power of σ of the force
  std::vector<Vector> passed_;  // coordinates of outputs
  Vector w_, end_, column_, products_, tail_;
};

}  // namespace seiche
