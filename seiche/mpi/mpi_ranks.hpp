// Processes that mpiexec has started.
#pragma once

#include <seiche/core/grid/ranks.hpp>

#include <memory>

namespace seiche {

// MPI from here to the end of the program, unless it has begun before.
class MpiSession {
 public:
  MpiSession();
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

 private:
  bool is_ours_;
};

// All processes of MPI_COMM_WORLD, in a communicator of its own.
std::unique_ptr<Ranks> mpi_ranks();
// Those of a communicator that is given as Fortran's handle (MPI_Comm_c2f, mpi4py's Comm.py2f).
std::unique_ptr<Ranks> mpi_ranks(int fortran_handle);

}  // namespace seiche
