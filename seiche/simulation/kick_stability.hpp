// Whether a step size suits the method: its explicit parts, its splitting, and the work of its exponentials.
#pragma once

#include <seiche/simulation/simulation.hpp>

#include <string>
#include <vector>

namespace seiche {

// What to say before a run with steps of one size h whose method kicks by all forces, where h is beyond the stability
// of the scheme at the fastest rate of the linear part (which is known from below); else "".
std::string beyond_stability(const Simulation& simulation, double h);

// The same where a rate γ(t) rises during the run so far above what the exponential of the method holds, its value at
// the start, that steps of h do not resolve it.
std::string beyond_rate(const Simulation& simulation, double h, TimeSpan run);

// The same where the method splits the damping from the forces, and at the rate with which it takes what they give the
// solution at the start, nothing is left of that after h.
std::string beyond_splitting(const Simulation& simulation, double h);

// The same where exponentials of the sparse backend take time in proportion to h times the fastest rate, and that is
// large.
std::string work_of_exponentials(const Simulation& simulation, const SparseOptions& options, double h, double duration);

// All of these: what there is to say of this h before a run.
std::vector<std::string> notes_on_step_size(const Simulation& simulation, const SparseOptions& options, double h,
                                            TimeSpan run);

}  // namespace seiche
