// The rows of a solution in files that are written once (docs/decisions/0029-sealed-segments.md). Whole chunks go to
// solution.h5.partial, which is sealed at a checkpoint: from then on it is solution/000001.h5, 000002.h5, …, and is
// never opened for writing again. The rows behind the last whole chunk are kept by the checkpoint.
#pragma once

#include <seiche/core/base/function_ref.hpp>
#include <seiche/core/control/archive.hpp>
#include <seiche/core/run_report.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/output/hdf5/hdf5.hpp>
#include <seiche/output/solution_columns.hpp>
#include <seiche/output/solution_layout.hpp>
#include <seiche/record/open_solution.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace seiche {

// What a checkpoint vouches for: all rows of a solution so far.
struct SegmentsMark {
  struct Segment {
    std::uint64_t rows = 0;
    FileMark file = {};
    void archive(Archive& a) { a(rows, file.length, file.checksum); }
  };
  std::vector<Segment> sealed = {};
  bool has_modified = false;                         // is there a modified energy?
  std::vector<std::vector<double>> unfinished = {};  // rows of the chunk that is not full, column by column

  std::uint64_t rows() const;
  std::size_t numbers() const { return has_modified ? 3 : 2; }  // columns behind those of the fields
  std::size_t fields() const { return unfinished.size() - numbers(); }
  void archive(Archive& a);
};

// Throws Error where it is of a solution with other fields, or another grid.
void require_layout(const SegmentsMark& mark, const SolutionLayout& layout, bool has_modified_energy);
// Why the segments of a folder are not those of the mark; "" where they are. Throws Error where one is missing, or
// cannot be read.
std::string complaint_about(const Folder& folder, const SegmentsMark& mark);
// All of them but the first `kept`; and their folder, where it is empty then. What is no HDF5 file stays. Nothing where
// the lock is no longer ours.
void remove_segments(const Folder& folder, std::size_t kept = 0);

class Segments {
 public:
  // Goes on behind the mark, which is one of the same layout, or of nothing: segments that it does not name are
  // removed when the next one begins, and those that it names are only read. At the end segments of so many bytes
  // together stay where they are. Throws Error where the mark is of another layout.
  Segments(Folder folder, SolutionLayout layout, SolutionDescription description, bool has_modified_energy,
           SegmentsMark mark = {}, double join_below = std::numeric_limits<double>::infinity());
  ~Segments();  // a segment that is not sealed is removed
  Segments(const Segments&) = delete;
  Segments& operator=(const Segments&) = delete;

  // A row: all fields one after the other, which `join` passes on piece by piece, and H, H_modified if there is one, t.
  // Throws Error where a chunk cannot be written; from then on everything does, and what is not sealed is gone, which
  // makes room.
  using Take = FunctionRef<void(std::span<const double> piece)>;
  void append(FunctionRef<void(Take)> join, std::span<const double> numbers);
  void append(std::span<const double> fields, std::span<const double> numbers) {
    append([&](Take take) { take(fields); }, numbers);
  }
  // The same where `join` passes on the chunks of the fields, for rows that fill them.
  using TakeChunk = FunctionRef<void(std::size_t field, const Hdf5Chunk& chunk)>;
  void append_chunks(FunctionRef<void(TakeChunk)> join, std::span<const double> numbers);
  // What was appended is on the disk under its final name, but for the rows that the mark holds. Throws Error where it
  // cannot be; the mark before this one still holds then.
  SegmentsMark seal();
  bool is_broken() const { return is_broken_; }                        // something could not be written
  bool is_finished() const { return is_finished_; }                    // solution.h5 is there
  bool is_joined() const { return is_finished_ && !shows_segments_; }  // solution.h5 needs none of them
  // solution.h5: the bytes that it has where nothing was ever sealed, or virtual data sets over segments that are too
  // large to be joined. The segments stay, and no row is taken any more. Throws Error where it cannot be written.
  void finish(const RunReport& report);

 private:
  OpenSolution& open();  // the segment that is being written
  void append_large(FunctionRef<void(Take)> join);
  template <class Visit>
  void by_fields(std::uint64_t at, std::span<const double> piece, const Visit& visit) const;
  void append_numbers(std::span<const double> numbers);
  void write_rows(OpenSolution& to);
  void require_writable() const;
  template <class Action>
  void attempt(const Action& action);

  Folder folder_;
  SolutionLayout layout_;
  SolutionDescription description_;
  std::uint64_t chunk_;  // rows
  SegmentsMark mark_;
  double join_below_;  // bytes
  std::unique_ptr<OpenSolution> open_;
  bool is_broken_ = false, is_finished_ = false, shows_segments_ = false;
};

}  // namespace seiche
