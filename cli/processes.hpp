// The program on several processes: mpiexec -n 4 seiche run case.toml.
#pragma once

#include "command_line.hpp"

#include <seiche/core/grid/ranks.hpp>

#include <functional>
#include <string>

namespace seiche::cli {

// Of commands that several processes carry out together: who they are; null where this one is alone.
const Ranks* join_others();
// Of all other commands. Throws Error where there are others.
void require_one_process(const std::string& command);
bool is_first(const Ranks* ranks);

// The end of the program. Where it failed, `say` says why: once for all processes, the first of which says it where all
// of them have come to their end. Where one of them fails alone, it says so, and ends the others.
int leave(ExitCode code, const std::function<void()>& say = {});

}  // namespace seiche::cli
