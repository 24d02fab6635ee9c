// A state in a file: its numbers with white space between, in the order of z. What `final.txt` of a run looks like.
#pragma once

#include <seiche/core/problem.hpp>
#include <seiche/simulation/simulation.hpp>

#include <filesystem>
#include <string>

namespace seiche {

// Throws Error with the line and the token that is no finite number, or with both counts where they differ.
Vector read_initial_file(const std::filesystem::path& file, const Problem& problem);

// What to say before a run from t_start that begins with such a file, where z is not all that a continued run would
// know; else "". `written_at`: the time of the state in the file, NaN where that is unknown.
std::string lost_between_runs(Simulation& simulation, double t_start, double written_at);

}  // namespace seiche
