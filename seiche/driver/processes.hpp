// The processes that mpiexec has started.
#pragma once

#include <seiche/core/grid/ranks.hpp>

#include <memory>

namespace seiche {

// How many there are, by what mpiexec or srun has told this one; 1 where neither has started it, or SEICHE_ALONE is
// set.
int started_processes();

// Begins MPI, from a library that is loaded for it: programs that run alone need none. Throws Error where that library
// is not there.
std::unique_ptr<Processes> join_processes();

}  // namespace seiche
