// Exponential Runge–Kutta schemes of one step, with the solution inside it.
#pragma once

#include <seiche/core/system.hpp>
#include <seiche/method/projection/base_step.hpp>

#include <memory>

namespace seiche {

// On L = SM − D₀ and N(t, z) = S∇V(z) − (D(t) − D₀)z, with φ_k of θhL:
//   U_1 = zⁿ,  N_i = N(tₙ + c_i h, U_i),  z(θ) = φ₀zⁿ + h Σ_k k! θ^{k+1} φ_{k+1} a_k,  a_k = Σ_j C_kj N_j,  ẑ = z(1),
// and U_i the same kind of sum at θ = c_i of the forces before it.
struct ExponentialTableau {
  struct Stage {
    double c;
    Index order;                  // how many φ-functions of each force before it
    std::vector<double> weights;  // as of PhiRow
  };
  std::vector<Stage> stages;  // after the first
  Index first_used;           // forces before this one have no part in z(θ)
  Eigen::MatrixXd C;          // powers of θ × forces from first_used on
  Eigen::MatrixXd C_coarse;   // the same of an order less, if there is one, for the coarser quadrature of ∫Q
  int coarse, fine;           // nodes of the two quadratures of the dissipation
  int nested;                 // and of the coarser one of those that share theirs: half the order of the scheme
};

// The exponential midpoint rule, of order two: two forces a step.
const ExponentialTableau& exponential_midpoint();
// ETDRK4-B of S. Krogstad, J. Comput. Phys. 203 (2005), of order four: four forces a step.
const ExponentialTableau& krogstad();

// `system`, `phi` and `tableau` outlive it. The linear part is the one of `phi`.
std::unique_ptr<BaseStep> exponential_runge_kutta(const System& system, const PhiEvaluator& phi,
                                                  const ExponentialTableau& tableau);

}  // namespace seiche
