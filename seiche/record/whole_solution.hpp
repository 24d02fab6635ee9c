// solution.h5 of what a mark of segments vouches for: the rows of all segments in one file, or one file that shows them
// where they lie.
#pragma once

#include <seiche/core/run_report.hpp>
#include <seiche/output/solution_columns.hpp>
#include <seiche/output/solution_layout.hpp>
#include <seiche/record/segments.hpp>

namespace seiche {

// Into the folder of the segments, by copying chunks as they are: the bytes that it has where nothing was ever sealed.
// Throws Error where the mark is of another layout, a segment cannot be read, or the file not written.
void join_segments(const Folder& folder, const SolutionLayout& layout, const SolutionDescription& description,
                   const SegmentsMark& mark, const RunReport& end);

// The same by virtual data sets over the segments, which stay where they are. Times, energies and the rows of the last
// chunk, which is not full, are in the file. Throws Error likewise.
void show_segments(const Folder& folder, const SolutionLayout& layout, const SolutionDescription& description,
                   const SegmentsMark& mark, const RunReport& end);

}  // namespace seiche
