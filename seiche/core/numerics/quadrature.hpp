// Gauss–Legendre rules as vectors, rules that hold them, and polynomials through their nodes.
#pragma once

#include <Eigen/Dense>

namespace seiche {

// ∫₀¹ f ≈ Σ weights_i f(nodes_i): core/numerics/gauss_rule.
struct GaussRule {
  explicit GaussRule(int s);
  Eigen::VectorXd nodes;  // increasing
  Eigen::VectorXd weights;
};

// Gauss's rule of s ≤ 4 nodes inside a finer one, which has both ends, all these nodes and s − 1 more: where the ends
// are known, as few as a second opinion takes, since with less it is that of Gauss. The more are the zeros of the
// polynomial e with
//   ∫₀¹ P_s(θ) θ(θ − 1) e(θ) θᵏ dθ = 0,  k = 0 … s − 2
// (Kronrod's condition with the ends prescribed), so that the finer rule is exact to degree 3s − 1, or 3s where s is
// odd.
struct NestedRules {
  explicit NestedRules(int s);
  GaussRule coarse;
  Eigen::VectorXd more;
  Eigen::VectorXd fine;  // weights of 0, 1, the nodes of `coarse` and `more`, in this order; all positive
};

// C with a = C f for the coefficients a of the polynomial Σ a_k θᵏ that takes the values f at `nodes`.
Eigen::MatrixXd interpolation(const Eigen::VectorXd& nodes);

// P with Pf the values at `points` of the polynomial that takes the values f at `nodes`.
Eigen::MatrixXd evaluation(const Eigen::VectorXd& nodes, const Eigen::VectorXd& points);

}  // namespace seiche
