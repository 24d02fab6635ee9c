// e^{−hD} for a constant sparse D.
#pragma once

#include <seiche/backend/krylov/product.hpp>
#include <seiche/backend/sparse/resolvent.hpp>
#include <seiche/core/grid/sparse_operators.hpp>
#include <seiche/core/numerics/linear_map.hpp>

#include <functional>
#include <memory>

namespace seiche {

// z ↦ Dz.
std::unique_ptr<LinearMap> sparse_map(const SparseMatrix& a);

std::unique_ptr<LinearMap> diagonal_map(Vector diagonal);

// z ↦ e^{−hD}z by diagonal Padé approximation, from products with D, a bound of its spectral radius and resolvents of
// −D; `size`: of the part of a vector that is here.
std::unique_ptr<LinearMap> pade_decay(std::shared_ptr<const Product> D, double radius,
                                      std::shared_ptr<const Resolvents> resolvents, Index size, double h);

// Makes z ↦ e^{−hD}z for any h: exactly where D is diagonal, otherwise by diagonal Padé approximation to round-off. As
// |r(x)| ≤ 1 for Re x ≤ 0, it does not raise ½zᵀMz where sym(MD) ⪰ 0 (von Neumann), whatever its error.
std::function<std::unique_ptr<LinearMap>(double h)> sparse_damping_flow(const SparseMatrix& D);

}  // namespace seiche
