// What methods with tables of φ-functions keep, in doubles per unknown. Constants are fitted to runs of all methods on
// 300² and 1024² points, with steps of one size and by a tolerance. per_mode: unknowns of a mode, two fields at most.
#pragma once

#include <seiche/core/base/vector.hpp>

namespace seiche {

// For how many of them tables, propagators and factors are kept.
double step_sizes(Index size, bool variable_steps);

// Two forces a stage and some vectors, and for each step size that is kept the blocks of stages, end and forms; with
// variable steps also those of the extension.
double doubles_of_collocation(int order, Index size, bool variable_steps, double per_mode);

// What it keeps beside that in gradient flows: of a few sweeps the nodes and what the next one changed them by.
double doubles_of_acceleration(int order);

// The forces of its stages, and of each step size, twice where an error is found by halving, the blocks of stages, end
// and forms.
double doubles_of_runge_kutta(int order, Index size, bool variable_steps, double per_mode);
// What a splitting works with, and of each step size the blocks of its linear flows and forms.
double doubles_of_splitting(int order, Index size, bool variable_steps, double per_mode);
double doubles_of_kicks(int order, Index size, bool variable_steps, double per_mode);

// What closures keep where steps are variable, beside that of fixed steps: states and forces of the error estimate, and
// of each step size its blocks and the propagator.
double doubles_of_estimate(Index size, double per_mode);

}  // namespace seiche
