// solution.h5 and solution.xdmf: t, H and the fields on their grid at every due step. The first is an HDF5 file that
// NetCDF-4 readers such as xarray open with named dimensions and coordinates, the second tells ParaView what is in
// it.
#pragma once

#include <seiche/core/control/archive.hpp>
#include <seiche/core/observer.hpp>
#include <seiche/core/problem.hpp>
#include <seiche/core/space.hpp>
#include <seiche/record/joint_row.hpp>
#include <seiche/record/segments.hpp>

#include <atomic>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace seiche {

struct SnapshotTimes {
  Schedule schedule = {};
  double interval = 0.0;  // > 0: at its multiples, and `schedule` counts for the first and the last state only
};

// Rows go to the disk chunk by chunk, so that memory does not grow with the run. At a checkpoint they are sealed
// (segments.hpp); what a program that is killed has not sealed is lost.
class SolutionFile : public Observer {
 public:
  // As far as it had come at a checkpoint.
  struct Mark {
    SegmentsMark rows = {};
    std::int64_t shown = 0;
    double last_t = -std::numeric_limits<double>::infinity();
    void archive(Archive& a) { a(rows, shown, last_t); }
  };

  // From the start, or behind the mark `from` in what an earlier run has left. `space` outlives the observer, and so do
  // `ranks`, who hold the parts of a row; null: this process has all. Segments of more bytes than `join_below` are not
  // joined.
  SolutionFile(const Folder& folder, const Problem& problem, const Space& space, const SnapshotTimes& times,
               bool has_modified_energy, const SolutionDescription& description = {}, const Mark* from = nullptr,
               double join_below = std::numeric_limits<double>::infinity(), const Ranks* ranks = nullptr);

  // Of another process than the first, which has the file: takes part in what is to come together there.
  SolutionFile(const Problem& problem, const Space& space, const SnapshotTimes& times, const Mark* from,
               const Ranks& ranks);

  bool is_due(const State& state, bool last) const override;
  double next_time() const override;
  void observe(const State& state, const EnergyReading& energy) override;
  void skip(const State& state) override;
  void finish(const RunReport& report) override;  // solution.h5, unless a row could not be written
  bool is_finished() const { return file_->segments.is_finished(); }
  bool is_joined() const { return file_->segments.is_joined(); }
  Mark mark();  // with its rows on the disk
  // solution.xdmf, after finish, for which ParaView asks; not where `stop` is set meanwhile. It shows every n-th time:
  // returns n.
  std::uint64_t describe(const std::atomic<bool>* stop = nullptr) const;

 private:
  SolutionFile(const Space& space, const SnapshotTimes& times, const Mark* from);
  void let_compress(const SolutionLayout& layout, const Ranks* ranks);
  void join(Segments::Take take);  // values_
  void pass_on();                  // the same where no row is written here
  std::span<const double> span_of_values() const { return {values_.data(), static_cast<std::size_t>(values_.size())}; }
  struct File {
    File(Folder in, SolutionLayout of, const SolutionDescription& description, bool has_modified_energy,
         SegmentsMark mark, double join_below)
        : folder(std::move(in)),
          layout(std::move(of)),
          has_modified(has_modified_energy),
          segments(folder, layout, description, has_modified, std::move(mark), join_below) {}

    Folder folder;
    SolutionLayout layout;
    bool has_modified;
    Segments segments;
  };
  std::optional<File> file_;
  std::optional<JointRow> joint_;  // where every process compresses its part
  const Space& space_;
  SnapshotTimes times_;
  std::int64_t shown_;  // multiples of the interval
  double last_t_;
  Vector values_;
};

}  // namespace seiche
