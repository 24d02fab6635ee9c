// e^{−hD} for a constant sparse D.
#pragma once

#include <seiche/core/grid/sparse_operators.hpp>
#include <seiche/core/numerics/linear_map.hpp>

#include <functional>
#include <memory>

namespace seiche {

// z ↦ Dz.
std::unique_ptr<LinearMap> sparse_map(const SparseMatrix& a);

// Makes z ↦ e^{−hD}z for any h: exactly where D is diagonal, otherwise by diagonal Padé approximation to round-off. As
// |r(x)| ≤ 1 for Re x ≤ 0, it does not raise ½zᵀMz where sym(MD) ⪰ 0 (von Neumann), whatever its error.
std::function<std::unique_ptr<LinearMap>(double h)> sparse_damping_flow(const SparseMatrix& D);

}  // namespace seiche
