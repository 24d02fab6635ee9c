// Passes over the forces of a collocation step.
#pragma once

#include <seiche/core/space.hpp>

#include <Eigen/Dense>

#include <span>

namespace seiche {

// out[i] ← Σ_j weights(i, j) in[j] in the components begin … begin + size − 1, with a square matrix of weights. Returns
// the largest of the Euclidean norms ‖out[i]‖ there.
double combine(const Space& space, const Eigen::MatrixXd& weights, std::span<const Vector> in, Index begin, Index size,
               std::span<Vector> out);

// ‖a − b‖, with a the components of `whole` from `begin` on
double distance(const Space& space, const Vector& whole, Index begin, const Vector& b);

}  // namespace seiche
