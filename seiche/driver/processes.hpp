// The processes that mpiexec has started.
#pragma once

#include <seiche/core/grid/ranks.hpp>

#include <memory>
#include <string>
#include <vector>

namespace seiche {

// How many there are, by what mpiexec or srun has told this one; 1 where neither has started it, or SEICHE_ALONE is
// set.
int started_processes();

// Begins MPI, from a library that is loaded for it: programs that run alone need none. Throws Error where that library
// is not there.
std::unique_ptr<Processes> join_processes();

// The processes of a communicator, given as Fortran's handle (mpi4py's Comm.py2f), of a program that has begun MPI.
// `folders`: where the library may lie too, from the library or module that this is a part of. Throws as above.
std::unique_ptr<Ranks> ranks_of_communicator(int fortran_handle, const std::vector<std::string>& folders);

}  // namespace seiche
