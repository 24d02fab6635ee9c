// The rows of a solution, wherever they lie: in sealed segments, and in the checkpoint that vouches for these.
#pragma once

#include <seiche/output/solution_reader.hpp>
#include <seiche/record/segments.hpp>

#include <filesystem>
#include <vector>

namespace seiche {

class RecordReader {
 public:
  // Of a run in this folder that goes on, or did not finish. Throws Error where a segment cannot be read, or has other
  // rows than the mark says.
  RecordReader(const std::filesystem::path& directory, SegmentsMark mark);

  Index count() const { return static_cast<Index>(mark_.rows()); }  // of times
  std::vector<double> times() const;
  std::vector<double> energies() const;
  std::vector<double> modified_energies() const;  // none where the method has none
  // Physical values at time k; all fields one after the other, in the order of z. Throws Error where there is no such
  // time.
  void state(Index k, Vector& values) const;

 private:
  using Numbers = std::vector<double> (SolutionReader::*)() const;
  // Of all times, those that are in memory in the column `from_end`, counted from the last.
  std::vector<double> all(Numbers of_segment, std::size_t from_end) const;

  SegmentsMark mark_;
  std::vector<SolutionReader> segments_;
};

}  // namespace seiche
