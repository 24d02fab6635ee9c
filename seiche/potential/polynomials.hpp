// Polynomial potentials from coefficients known at run time.
#pragma once

#include <seiche/core/grid/grid.hpp>
#include <seiche/core/potential.hpp>

#include <memory>
#include <vector>

namespace seiche {

inline constexpr int max_polynomial_degree = 16;

// V = Σ_j W(u_j) and V = Σ_j W(u_{j+1} − u_j) with W(u) = Σ c_i uⁱ. Throw Error above max_polynomial_degree.
std::shared_ptr<const PointwisePotential> nodal_polynomial(const std::vector<double>& c);
std::shared_ptr<const PointwisePotential> bond_polynomial(const std::vector<double>& c, Boundary boundary);

// V = Σ_j W(u_j² + v_j²) of two fields with W(ρ) = Σ c_i ρⁱ.
std::shared_ptr<const PointwisePotential> modulus_polynomial(const std::vector<double>& c);

// c uᵈ as coefficients.
std::vector<double> monomial(double c, int d);

}  // namespace seiche
