// What second-order equations u_tt = … share: z = (u, v) with v = u_t, and S = [[0, I], [−I, 0]].
#pragma once

#include <seiche/core/damping_rate.hpp>
#include <seiche/core/problem.hpp>

#include <functional>
#include <vector>

namespace seiche {

// M = diag(stiffness, I), D = diag(0, γI), z₀ = 0.
Problem wave_problem(std::string name, const Grid& grid, const Stencil& stiffness, const DampingRate& gamma);

// D = γP with P the projection on the marked fields; none where γ is the constant 0.
LinearDamping rate_damping(const DampingRate& gamma, const Grid& grid, std::vector<bool> fields);

// Values of f(x_j) on the grid.
Vector sample(const Grid& grid, const std::function<double(double x)>& f);  // of the first axis
double squared_distance_from_centre(const Grid& grid, Index point);         // |x − L/2|²

}  // namespace seiche
