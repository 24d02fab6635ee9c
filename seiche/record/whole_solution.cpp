#include <seiche/record/open_solution.hpp>
#include <seiche/record/whole_solution.hpp>

#include <fmt/format.h>

#include <string>
#include <vector>

namespace seiche {
namespace {

// Behind the last row of a column of numbers: those of a segment.
void append_numbers(Hdf5Dataset& to, const Hdf5Dataset& from, std::uint64_t first, std::uint64_t rows) {
  std::vector<double> values(rows);
  from.read(first, values);
  to.append(values);
}

}  // namespace

// Segments hold whole chunks, so that their bytes are those of the chunks here. Column by column within a chunk, as a
// run writes them: in another order the file would have other bytes.
void join_segments(const Folder& folder, const SolutionLayout& layout, const SolutionDescription& description,
                   const SegmentsMark& mark, const RunReport& end) {
  require_layout(mark, layout, mark.has_modified);
  OpenSolution to(folder, layout, description, mark.has_modified);
  const Folder inside = folder.inside(segments_folder);
  const std::uint64_t chunk = layout.chunk().front();
  for (std::size_t k = 0; k < mark.sealed.size(); ++k) {
    const Hdf5File from = Hdf5File::open(inside, segment_name(k + 1));
    std::vector<Hdf5Dataset> columns;
    for (const Hdf5Dataset& column : to.columns) columns.push_back(from.dataset(column.name()));
    for (std::uint64_t first = 0; first < mark.sealed[k].rows; first += chunk) {
      for (std::size_t i = 0; i < columns.size(); ++i) {
        if (i < mark.fields()) {
          to.columns[i].append_chunks(columns[i], first, chunk);
        } else {
          append_numbers(to.columns[i], columns[i], first, chunk);
        }
      }
    }
  }
  for (std::size_t i = 0; i < to.columns.size(); ++i) to.columns[i].append(mark.unfinished[i]);
  to.commit(layout, end);
}

void show_segments(const Folder& folder, const SolutionLayout& layout, const SolutionDescription& description,
                   const SegmentsMark& mark, const RunReport& end) {
  require_layout(mark, layout, mark.has_modified);
  std::vector<RowsOfFields> parts;
  for (std::size_t k = 0; k < mark.sealed.size(); ++k)
    parts.push_back({.file = fmt::format("{}/{}", segments_folder, segment_name(k + 1)), .rows = mark.sealed[k].rows});
  const std::uint64_t rest = mark.unfinished.back().size(), chunk = layout.chunk().front();
  if (rest > 0) parts.push_back({.file = "", .rows = rest});
  OpenSolution to(folder, layout, description, mark.has_modified, parts);
  for (std::size_t k = 0; k < mark.sealed.size(); ++k) {
    const Hdf5File from = Hdf5File::open(folder.inside(segments_folder), segment_name(k + 1));
    for (std::size_t i = mark.fields(); i < to.columns.size(); ++i) {
      const Hdf5Dataset column = from.dataset(to.columns[i].name());
      for (std::uint64_t first = 0; first < mark.sealed[k].rows; first += chunk)
        append_numbers(to.columns[i], column, first, chunk);
    }
  }
  if (rest > 0) to.file.make_group(rest_group);
  for (std::size_t i = 0; i < to.columns.size(); ++i) {
    if (i >= mark.fields()) {
      to.columns[i].append(mark.unfinished[i]);
    } else if (rest > 0) {
      const std::string name = fmt::format("{}/{}", rest_group, to.columns[i].name());
      to.file.make_dataset(name, {.row = layout.shape(), .chunk = layout.chunk()}).append(mark.unfinished[i]);
    }
  }
  to.commit(layout, end);
}

}  // namespace seiche
