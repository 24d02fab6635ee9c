// How many transforms of a field a step makes, by counting what V is asked for.
#pragma once

#include <seiche/core/problem.hpp>

#include <string>

namespace seiche::bench {

// Per step and field of V, in the mean over some steps of length h on the modal backend. Throws Error where one fails.
double transforms_per_step(const Problem& problem, const std::string& method, double h);

}  // namespace seiche::bench
