// What methods with tables of φ-functions keep, in doubles per unknown.
#pragma once

#include <seiche/core/base/vector.hpp>

namespace seiche {

// Two forces a stage and some vectors, and for each step size that is kept the blocks of stages, end and forms; with
// variable steps also those of the extension. slots: real numbers to a mode.
double doubles_of_collocation(int order, Index size, bool variable_steps, double slots);

// What it keeps beside that in gradient flows: of a few sweeps the nodes and what the next one changed them by.
double doubles_of_acceleration(int order);

// The same for one-step methods: their forces or what a splitting works with, and of each step size the blocks of
// stages, end and forms, or of the linear flows.
double doubles_of_one_step(int order, Index size, bool variable_steps, double slots);

}  // namespace seiche
