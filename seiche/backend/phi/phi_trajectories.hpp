// Rows of φ-functions that are values of one trajectory.
#pragma once

#include <seiche/core/phi.hpp>

#include <Eigen/Dense>

#include <vector>

namespace seiche {

// u(σ) of u' = θhLu + h Σ_j Σ_k W_jk σᵏ/k! n_j, u(0) = z, is the sum of a row with the weights σ^{k+1} W_jk at σθ. Rows
// of collocation, with the weights k! θ^{k+1} C_kj, all lie on the trajectory of the last of them.
struct PhiTrajectory {
  double theta;
  Eigen::MatrixXd weights;        // W, forces × order
  std::vector<double> sigmas;     // increasing, in (0, 1]
  std::vector<std::size_t> rows;  // the row at each σ
};

// Every row lies on one of them.
std::vector<PhiTrajectory> phi_trajectories(const PhiRows& rows);

}  // namespace seiche
