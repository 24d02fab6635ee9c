// What programs load where mpiexec has started them.
#pragma once

#include <seiche/core/grid/ranks.hpp>

// All processes of MPI_COMM_WORLD. MPI begins here, and ends with the object, which belongs to the caller.
extern "C" seiche::Processes* seiche_mpi_processes();
// Those of a communicator that is given as Fortran's handle, of a program that has begun MPI.
extern "C" seiche::Ranks* seiche_mpi_ranks(int fortran_handle);
extern "C" const char* seiche_mpi_version();  // of the sources that it was built of
