// What exponentials of the sparse backend cost where steps are long beside the fastest rate.
#pragma once

#include <seiche/config/simulation.hpp>

#include <string>
#include <vector>

namespace seiche {

// What to say before a run by steps of one size h whose exponentials take time in proportion to h times the fastest
// rate, where that is large; else "".
std::string work_of_exponentials(const Simulation& simulation, const SparseOptions& options, double h, double t_end);

// That, and all of kick_stability.hpp: what there is to say of this h before a run, a sentence each.
std::vector<std::string> notes_on_step_size(const Simulation& simulation, const SparseOptions& options, double h,
                                            double t_end);

}  // namespace seiche
