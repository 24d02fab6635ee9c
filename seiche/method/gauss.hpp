// Gauss–Legendre quadrature on [0, 1], and polynomials through its nodes.
#pragma once

#include <Eigen/Dense>

namespace seiche {

// ∫₀¹ f ≈ Σ weights_i f(nodes_i), exact for polynomials of degree 2s − 1.
struct GaussRule {
  explicit GaussRule(int s);
  Eigen::VectorXd nodes;  // increasing
  Eigen::VectorXd weights;
};

// C with a = C f for the coefficients a of the polynomial Σ a_k θᵏ that takes the values f at `nodes`.
Eigen::MatrixXd interpolation(const Eigen::VectorXd& nodes);

// P with Pf the values at `points` of the polynomial that takes the values f at `nodes`.
Eigen::MatrixXd evaluation(const Eigen::VectorXd& nodes, const Eigen::VectorXd& points);

}  // namespace seiche
