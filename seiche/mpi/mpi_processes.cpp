#include <seiche/mpi/mpi_processes.hpp>
#include <seiche/mpi/mpi_ranks.hpp>

#include <mpi.h>
#include <seiche/version.hpp>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <thread>

namespace seiche {
namespace {

class MpiProcesses final : public Processes {
 public:
  MpiProcesses() : ranks_(mpi_ranks()) {
    MPI_Comm_dup(MPI_COMM_WORLD, &at_end_);
    MPI_Comm_set_errhandler(at_end_, MPI_ERRORS_RETURN);
  }
  ~MpiProcesses() override { MPI_Comm_free(&at_end_); }
  MpiProcesses(const MpiProcesses&) = delete;
  MpiProcesses& operator=(const MpiProcesses&) = delete;

  const Ranks& ranks() const override { return *ranks_; }

  int count_on_machine() const override {
    MPI_Comm machine = MPI_COMM_NULL;
    int count = 1;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    MPI_Comm_size(machine, &count);
    MPI_Comm_free(&machine);
    return count;
  }

  bool come_to_end(double patience) override {
    MPI_Request request = MPI_REQUEST_NULL;
    if (MPI_Ibarrier(at_end_, &request) != MPI_SUCCESS) return false;
    const auto begin = std::chrono::steady_clock::now();
    for (int come = 0;;) {
      if (MPI_Test(&request, &come, MPI_STATUS_IGNORE) != MPI_SUCCESS) return false;
      if (come != 0) return true;
      if (std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() > patience) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  [[noreturn]] void end_all(int exit_code) override {
    MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::abort();
  }

 private:
  MpiSession session_;
  std::unique_ptr<Ranks> ranks_;
  MPI_Comm at_end_ = MPI_COMM_NULL;
};

}  // namespace
}  // namespace seiche

const char* seiche_mpi_version() { return seiche::version_commit.data(); }
seiche::Ranks* seiche_mpi_ranks(int fortran_handle) { return seiche::mpi_ranks(fortran_handle).release(); }
seiche::Processes* seiche_mpi_processes() { return new seiche::MpiProcesses; }
