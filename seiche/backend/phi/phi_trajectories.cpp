#include <seiche/backend/phi/phi_trajectories.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace seiche {
namespace {

Eigen::MatrixXd weight_matrix(const PhiRows& rows, const PhiRow& row) {
  Eigen::MatrixXd weights(rows.forces, rows.order);
  for (Index j = 0; j < rows.forces; ++j)
    for (Index k = 0; k < rows.order; ++k) weights(j, k) = row.weights[static_cast<std::size_t>(j * rows.order + k)];
  return weights;
}

// Are these σ^{k+1} W_jk?
bool lie_on(const PhiTrajectory& trajectory, double sigma, const Eigen::MatrixXd& weights) {
  constexpr double round_off = 1e-14;
  if (!(sigma > 0 && sigma <= 1)) return false;
  double power = 1;
  for (Index k = 0; k < weights.cols(); ++k) {
    power *= sigma;
    const auto of_trajectory = trajectory.weights.col(k) * power;
    if ((weights.col(k) - of_trajectory).lpNorm<Eigen::Infinity>() >
        round_off * of_trajectory.lpNorm<Eigen::Infinity>())
      return false;
  }
  return true;
}

}  // namespace

std::vector<PhiTrajectory> phi_trajectories(const PhiRows& rows) {
  std::vector<std::size_t> order(rows.rows.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rows.rows[a].theta > rows.rows[b].theta; });
  std::vector<PhiTrajectory> trajectories;
  for (const std::size_t i : order) {
    const PhiRow& row = rows.rows[i];
    const Eigen::MatrixXd weights = weight_matrix(rows, row);
    const auto found = std::find_if(trajectories.begin(), trajectories.end(), [&](const PhiTrajectory& trajectory) {
      return lie_on(trajectory, row.theta / trajectory.theta, weights);
    });
    if (found == trajectories.end()) {
      trajectories.push_back({row.theta, weights, {1.0}, {i}});
    } else {
      found->sigmas.push_back(row.theta / found->theta);
      found->rows.push_back(i);
    }
  }
  for (PhiTrajectory& trajectory : trajectories) {
    std::reverse(trajectory.sigmas.begin(), trajectory.sigmas.end());
    std::reverse(trajectory.rows.begin(), trajectory.rows.end());
  }
  return trajectories;
}

}  // namespace seiche
