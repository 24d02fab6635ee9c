// What exponentials of the sparse backend cost where steps are long beside the fastest rate.
#pragma once

#include <seiche/simulation/simulation.hpp>

#include <string>

namespace seiche {

// What to say before a run by steps of one size h whose exponentials take time in proportion to h times the fastest
// rate, where that is large; else "".
std::string work_of_exponentials(const Simulation& simulation, const SparseOptions& options, double h, double t_end);

}  // namespace seiche
