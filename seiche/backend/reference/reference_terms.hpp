// V and D of the reference backend.
#pragma once

#include <seiche/core/damping.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/core/problem.hpp>

#include <Eigen/Core>

#include <memory>

namespace seiche {

// V of a problem that has one, on the components of z themselves. Mean gradients of polynomials of one field are by
// Gauss's rule; others are the potential's own, since each may choose another mean.
std::unique_ptr<Potential> reference_potential(const Problem& problem);

// D(t) = C + diag(γ), and friction. `estimates`: how large rates are and what a quadrature misses of them, which
// decides steps and quadratures and is no term of the equation.
std::unique_ptr<Damping> reference_damping(const Problem& problem, const Eigen::MatrixXd& C,
                                           std::unique_ptr<Damping> estimates);

}  // namespace seiche
