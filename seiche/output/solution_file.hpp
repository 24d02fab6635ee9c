// solution.h5 and solution.xdmf: t, H and the fields on their grid at every due step. The first is an HDF5 file that
// NetCDF-4 readers such as xarray open with named dimensions and coordinates, the second tells ParaView what is in
// it.
#pragma once

#include <seiche/core/control/archive.hpp>
#include <seiche/core/observer.hpp>
#include <seiche/core/problem.hpp>
#include <seiche/core/space.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/output/file/flush_clock.hpp>
#include <seiche/output/hdf5/hdf5.hpp>
#include <seiche/output/solution_columns.hpp>
#include <seiche/output/solution_layout.hpp>

#include <atomic>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace seiche {

inline constexpr const char* settling_name = ".seiche.solution.h5";  // of a file that is to become solution.h5

struct SnapshotTimes {
  Schedule schedule = {};
  double interval = 0.0;  // > 0: at its multiples, and `schedule` counts for the first and the last state only
};

// Rows go to the disk chunk by chunk, and at least every five seconds: memory does not grow with the run, and a
// program that is killed leaves a readable solution.h5.partial behind. What is once in the file stays readable,
// whatever fails later: then the file gets its name all the same, with the status "unfinished".
class SolutionFile : public Observer {
 public:
  // As far as it had come at a checkpoint. The checksum is that of t, the energies, and the fields of the last chunk:
  // of all their chunks it would take as long as the run has written.
  struct Mark {
    std::uint64_t rows = 0, in_last = 0;  // in all, and in the last chunk
    std::uint32_t checksum = checksum_of_nothing;
    std::int64_t shown = 0;
    double last_t = -std::numeric_limits<double>::infinity();
    void archive(Archive& a) { a(rows, in_last, checksum, shown, last_t); }
  };

  // `space` outlives the observer. Throws Error where nothing can be written.
  SolutionFile(const Folder& folder, const Problem& problem, const Space& space, const SnapshotTimes& times,
               bool has_modified_energy, const SolutionDescription& description = {});
  // Goes on behind the mark in a copy of the file that an earlier run has left, which describes itself as that did. The
  // copy takes its place when it is on the disk.
  SolutionFile(const Folder& folder, const Mark& mark, const Problem& problem, const Space& space,
               const SnapshotTimes& times, bool has_modified_energy, const SolutionDescription& description = {});
  // Why that file does not begin as it was at the mark; "" where it does.
  static std::string complaint(const Folder& folder, const Mark& mark);
  ~SolutionFile() override;  // without finish, what was observed stays as solution.h5.partial

  bool is_due(const State& state, bool last) const override;
  double next_time() const override;
  void observe(const State& state, const EnergyReading& energy) override;
  void pass(const State& state) override;
  void finish(const RunReport& report) override;  // solution.h5
  // Called before rows go to the disk: what is written of the same run elsewhere goes first.
  void before_writing(std::function<void()> call) { before_writing_ = std::move(call); }
  Mark mark();  // with its rows on the disk
  // After finish: the bytes that the file has where no row went to the disk before its chunk was full, so that they
  // depend on the run and not on the clock, nor on whether it was stopped on its way. Not for a run that did not
  // reach its end, one of more than 256 MB, and where `stop` is set meanwhile.
  void settle(const std::atomic<bool>* stop = nullptr) const;
  // solution.xdmf, after finish, for which ParaView asks; not where `stop` is set meanwhile. It shows every n-th time:
  // returns n.
  std::uint64_t describe(const std::atomic<bool>* stop = nullptr) const;

 private:
  struct Column {  // a data set with its rows that are not yet written, or whose chunk is not yet full
    Hdf5Dataset data;
    std::vector<double> rows = {};
    std::uint32_t last_chunk = checksum_of_nothing;  // of its rows in the last chunk
  };
  void begin_chunk();
  bool copy_rows(const Hdf5File& from, std::uint64_t rows, const std::atomic<bool>* stop = nullptr);
  explicit SolutionFile(const SolutionFile* settling);  // a new one, to take the place of that one
  void begin();
  void add(Column& column, std::span<const double> row) const;
  void write_rows(bool last);
  void close(const RunReport& report);

  PartialPath path_;
  SolutionLayout layout_;
  SolutionDescription description_;
  Hdf5File file_;
  const Space& space_;
  SnapshotTimes times_;
  std::int64_t shown_ = 0;  // multiples of the interval
  double last_t_ = -std::numeric_limits<double>::infinity();
  std::vector<Column> columns_;  // the fields, H, H_modified if there is one, t
  bool has_modified_;
  bool is_copy_ = false;                    // without commit nothing is lost
  bool is_settled_ = true;                  // all chunks were full when they were written
  RunReport report_;                        // that of finish
  bool broken_ = false;                     // a row could not be written
  std::size_t waiting_ = 0, most_waiting_;  // rows of the chunk that is not yet full
  std::size_t written_ = 0;                 // of them
  FlushClock clock_;
  Vector values_;
  std::function<void()> before_writing_;
};

}  // namespace seiche
