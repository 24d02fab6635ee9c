// The linear substep of the dense backend as full matrices, whose energy law holds however fast the fastest frequency.
#pragma once

#include <seiche/core/propagator.hpp>

#include <Eigen/Dense>

namespace seiche {

// F and FM, and for the predictor Q and QM. With T these lead to coordinates of energy, and T from there to z; without,
// to z.
struct DenseForce {
  Eigen::MatrixXd F, FM, Q, QM;
  Eigen::MatrixXd T;  // 0 × 0: none
};

// Throws Error where sym(S) ⪯ 0, and F + Fᵀ + FᵀMF ⪯ 0 cannot be kept to round-off.
DenseForce dense_force(PropagatorKind kind, const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, double h);

}  // namespace seiche
