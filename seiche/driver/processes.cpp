#include <seiche/core/base/error.hpp>
#include <seiche/core/base/loaded_library.hpp>
#include <seiche/driver/processes.hpp>

#include <cstdlib>

namespace seiche {
namespace {

template <class Function>
Function* of_library(const char* name, const std::vector<std::string>& folders = {}) {
  return reinterpret_cast<Function*>(function_of_library("libseiche_mpi.so", "seiche_mpi_version", name, folders));
}

constexpr const char* built_without =
    "this copy of Seiche knows only one: it was built without MPI (Debian packages libopenmpi-dev and openmpi-bin)";

}  // namespace

int started_processes() {
  if (const char* const alone = std::getenv("SEICHE_ALONE"); alone != nullptr && *alone != '\0') return 1;
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"})
    if (const char* const text = std::getenv(name)) return std::atoi(text);
  return 1;
}

std::unique_ptr<Processes> join_processes() {
  if (auto* const join = of_library<Processes*()>("seiche_mpi_processes")) return std::unique_ptr<Processes>(join());
  throw Error("{} processes were started, and {}", started_processes(), built_without);
}

std::unique_ptr<Ranks> ranks_of_communicator(int fortran_handle, const std::vector<std::string>& folders) {
  if (auto* const ranks = of_library<Ranks*(int)>("seiche_mpi_ranks", folders))
    return std::unique_ptr<Ranks>(ranks(fortran_handle));
  throw Error("comm stands for several processes, and {}", built_without);
}

}  // namespace seiche
