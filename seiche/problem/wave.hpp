// What second-order equations u_tt = … share: z = (u, v) with v = u_t, and S = [[0, I], [−I, 0]].
#pragma once

#include <seiche/core/problem.hpp>

#include <functional>

namespace seiche {

// M = diag(stiffness, I), D = diag(0, γ(t)I), z₀ = 0.
Problem wave_problem(std::string name, const Grid& grid, const Stencil& stiffness, RatePointer gamma);

// Values of f(x_j) on the grid.
Vector sample(const Grid& grid, const std::function<double(double x)>& f);  // of the first axis

}  // namespace seiche
