// φ-functions of the reference backend.
#pragma once

#include <seiche/core/phi.hpp>
#include <seiche/core/potential.hpp>

#include <Eigen/Core>

#include <memory>

namespace seiche {

// S, M, D₀: square, in physical coordinates. `support`: the components that V depends on.
std::unique_ptr<PhiEvaluator> reference_phi(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M,
                                            const Eigen::MatrixXd& D0, Potential::Support support);

}  // namespace seiche
