#include <seiche/core/base/error.hpp>
#include <seiche/mpi/mpi_ranks.hpp>

#include <mpi.h>

#include <limits>
#include <string>
#include <vector>

namespace seiche {
namespace {

void require(int code, const char* what) {
  if (code == MPI_SUCCESS) return;
  std::string text(MPI_MAX_ERROR_STRING, '\0');
  int length = 0;
  MPI_Error_string(code, text.data(), &length);
  text.resize(static_cast<std::size_t>(length));
  throw Error("MPI could not {}: {}", what, text);
}

// Counts of a call, and where each begins.
struct Counts {
  std::vector<int> counts, begins;

  void set(std::span<const Index> given) {
    counts.clear();
    begins.clear();
    Index begin = 0;
    for (const Index count : given) {
      if (begin + count > std::numeric_limits<int>::max())
        throw Error("a process exchanges more than 2³¹ numbers at a time; use more processes");
      counts.push_back(static_cast<int>(count));
      begins.push_back(static_cast<int>(begin));
      begin += count;
    }
  }
};

class MpiRanks final : public Ranks {
 public:
  explicit MpiRanks(MPI_Comm communicator) {
    require(MPI_Comm_dup(communicator, &communicator_), "make a communicator");
    MPI_Comm_set_errhandler(communicator_, MPI_ERRORS_RETURN);
    MPI_Comm_rank(communicator_, &here_.index);
    MPI_Comm_size(communicator_, &here_.count);
  }
  ~MpiRanks() override {
    int is_over = 0;
    MPI_Finalized(&is_over);
    if (is_over == 0) MPI_Comm_free(&communicator_);
  }
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  Rank here() const override { return here_; }

  void gather(std::span<const double> mine, std::span<const Index> counts, std::span<double> all) const override {
    received_.set(counts);
    require(MPI_Allgatherv(mine.data(), static_cast<int>(mine.size()), MPI_DOUBLE, all.data(), received_.counts.data(),
                           received_.begins.data(), MPI_DOUBLE, communicator_),
            "gather numbers");
  }

  void exchange(std::span<const double> from, std::span<const Index> sent, std::span<double> to,
                std::span<const Index> received) const override {
    sent_.set(sent);
    received_.set(received);
    for (Counts* numbers : {&sent_, &received_}) numbers->counts[static_cast<std::size_t>(here_.index)] = 0;
    require(MPI_Alltoallv(from.data(), sent_.counts.data(), sent_.begins.data(), MPI_DOUBLE, to.data(),
                          received_.counts.data(), received_.begins.data(), MPI_DOUBLE, communicator_),
            "exchange planes");
  }

 private:
  MPI_Comm communicator_ = MPI_COMM_NULL;
  Rank here_;
  mutable Counts sent_, received_;
};

}  // namespace

MpiSession::MpiSession() {
  int begun = 0;
  MPI_Initialized(&begun);
  is_ours_ = begun == 0;
  int threads = 0;  // of this process one alone calls MPI
  if (is_ours_) require(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &threads), "begin");
}

MpiSession::~MpiSession() {
  if (is_ours_) MPI_Finalize();
}

std::unique_ptr<Ranks> mpi_ranks() { return std::make_unique<MpiRanks>(MPI_COMM_WORLD); }

std::unique_ptr<Ranks> mpi_ranks(int fortran_handle) {
  return std::make_unique<MpiRanks>(MPI_Comm_f2c(fortran_handle));
}

}  // namespace seiche
