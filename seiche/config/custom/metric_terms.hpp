// From the quadratic terms of an energy to the stencils of M.
#pragma once

#include <seiche/config/custom/energy_split.hpp>
#include <seiche/core/grid/grid.hpp>
#include <seiche/core/grid/stencil.hpp>

namespace seiche {

// M ← M + what makes ½zᵀMz grow by the term. Throws Error for products that no difference is there for: of derivatives
// along different axes, of bonds with points, and of odd order where ends are not periodic.
void add_quadratic(const QuadraticTerm& term, const Grid& grid, Discretisation discretisation, BlockStencil& M);

}  // namespace seiche
