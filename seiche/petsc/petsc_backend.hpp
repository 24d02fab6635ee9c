// The backend "petsc", for programs that load it.
#pragma once

#include <seiche/core/system.hpp>

// A problem of matrices, or of differences on a grid of any number of axes, by Mat and KSP: on the processes that
// options.ranks names, which are those of MPI_COMM_WORLD, or on this one alone. On several the problem is the whole one
// on each, whose points they divide; potentials that join points are then computed by each of them for all. The system
// belongs to the caller. Throws Error where the problem asks for more, and where PETSc fails, with what it says.
extern "C" seiche::System* seiche_petsc_system(const seiche::Problem& problem, const seiche::BackendOptions& options);
extern "C" const char* seiche_petsc_version();  // of the sources that it was built of
