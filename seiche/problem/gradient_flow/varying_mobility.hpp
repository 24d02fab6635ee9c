// Mobilities that follow the field: u_t = −M(u) δH/δu, or ∇·(M(u)∇ δH/δu).
#pragma once

#include <seiche/core/problem.hpp>
#include <seiche/problem/common/grid_options.hpp>

namespace seiche {

// S(u) = S + S'(u) of one field, with S that of the constant mobility m: S'(u) = m − M(u), or ∇·(M(u) − m)∇, which
// keeps the mean. By fd2 M stands between neighbours, as the mean of both; by spectral derivatives, on periodic grids,
// at the points. m of about the middle of what M takes makes S' small beside S. Where M(u) < 0, 0 stands for it, and
// PointwiseStructure::complaint_about says so. Throws Error where `grid` has no such derivatives.
void add_varying_mobility(Problem& problem, StateFunctionPointer M, double m, bool conserves_mean,
                          const GridOptions& grid);

// The middle of the least and the largest M(u) ≥ 0 for u from `low` to `high` and a tenth of their distance beyond.
// Throws Error where M is not a number there, or nowhere positive.
double middle_mobility(const StateFunction& M, double low, double high);

}  // namespace seiche
