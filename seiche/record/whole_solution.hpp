// solution.h5 of what a mark of segments vouches for: the rows of all segments in one file, or one file that shows them
// where they lie.
#pragma once

#include <seiche/core/run_report.hpp>
#include <seiche/output/solution_columns.hpp>
#include <seiche/output/solution_layout.hpp>
#include <seiche/record/segments.hpp>

#include <string>

namespace seiche {

// Into the folder of the segments, by copying chunks as they are: the bytes that it has where nothing was ever sealed.
// Throws Error where a segment cannot be read, or the file not written.
void join_segments(const Folder& folder, const SolutionLayout& layout, const SolutionDescription& description,
                   const SegmentsMark& mark, const RunReport& end);

// Into any folder, by virtual data sets over the segments, which stay in `segments`: "solution", beside it, or a whole
// path. Times, energies and the rows of the last chunk, which is not full, are in the file. Throws Error likewise.
void show_segments(const Folder& folder, const std::string& segments, const SolutionLayout& layout,
                   const SolutionDescription& description, const SegmentsMark& mark, const RunReport& end);

}  // namespace seiche
