// The program on several processes: mpiexec -n 4 seiche run case.toml.
#pragma once

#include "command_line.hpp"

#include <seiche/core/grid/ranks.hpp>

#include <functional>
#include <string>
#include <vector>

namespace seiche::cli {

// Before a command that several processes carry out together. Throws Error where others were given other arguments,
// which are no work for all of them.
void join_others(const std::vector<std::string>& arguments);
const Ranks* processes();  // those that have joined; null where this one is alone
bool is_first();

// The end of the program. Where it failed, `say` says why: once for all processes, the first of which says it where all
// of them have come to their end. Where one of them fails alone, it says so, and ends the others.
int leave(ExitCode code, const std::function<void()>& say = {});

}  // namespace seiche::cli
