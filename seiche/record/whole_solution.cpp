#include <seiche/record/open_solution.hpp>
#include <seiche/record/whole_solution.hpp>

#include <filesystem>
#include <vector>

namespace seiche {
namespace {

void append_numbers(Hdf5Dataset& to, const Hdf5File& segment, std::uint64_t rows, std::uint64_t chunk) {
  const Hdf5Dataset from = segment.dataset(to.name());
  std::vector<double> values(chunk);
  for (std::uint64_t first = 0; first < rows; first += chunk) {
    from.read(first, values);
    to.append(values);
  }
}

}  // namespace

// Segments hold whole chunks, so that their bytes are those of the chunks here. Column by column within a chunk, as a
// run writes them: in another order the file would have other bytes.
void join_segments(const Folder& folder, const SolutionLayout& layout, const SolutionDescription& description,
                   const SegmentsMark& mark, const RunReport& end) {
  OpenSolution to(folder, layout, description, mark.has_modified);
  const Folder inside = folder.inside(segments_folder);
  const std::uint64_t chunk = layout.chunk().front();
  std::vector<double> numbers(chunk);
  for (std::size_t k = 0; k < mark.sealed.size(); ++k) {
    const Hdf5File from = Hdf5File::open(inside, segment_name(k + 1));
    std::vector<Hdf5Dataset> columns;
    for (const Hdf5Dataset& column : to.columns) columns.push_back(from.dataset(column.name()));
    for (std::uint64_t first = 0; first < mark.sealed[k].rows; first += chunk) {
      for (std::size_t i = 0; i < columns.size(); ++i) {
        if (i < mark.fields()) {
          to.columns[i].append_chunks(columns[i], first, chunk);
        } else {
          columns[i].read(first, numbers);
          to.columns[i].append(numbers);
        }
      }
    }
  }
  for (std::size_t i = 0; i < to.columns.size(); ++i) to.columns[i].append(mark.unfinished[i]);
  to.commit(layout, end);
}

void show_segments(const Folder& folder, const std::string& segments, const SolutionLayout& layout,
                   const SolutionDescription& description, const SegmentsMark& mark, const RunReport& end) {
  std::vector<RowsOfFields> parts;
  for (std::size_t k = 0; k < mark.sealed.size(); ++k)
    parts.push_back({.file = std::filesystem::path(segments) / segment_name(k + 1), .rows = mark.sealed[k].rows});
  const std::uint64_t rest = mark.unfinished.back().size(), chunk = layout.chunk().front();
  if (rest > 0) parts.push_back({.file = "", .rows = rest});
  OpenSolution to(folder, layout, description, mark.has_modified, parts);
  for (std::size_t k = 0; k < mark.sealed.size(); ++k) {
    const Folder inside = std::filesystem::path(segments).is_absolute() ? Folder(segments) : folder.inside(segments);
    const Hdf5File from = Hdf5File::open(inside, segment_name(k + 1));
    for (std::size_t i = mark.fields(); i < to.columns.size(); ++i)
      append_numbers(to.columns[i], from, mark.sealed[k].rows, chunk);
  }
  if (rest > 0) to.file.make_group(rest_group);
  for (std::size_t i = 0; i < to.columns.size(); ++i) {
    if (i >= mark.fields()) {
      to.columns[i].append(mark.unfinished[i]);
    } else if (rest > 0) {
      const std::string name = std::string(rest_group) + "/" + to.columns[i].name();
      to.file.make_dataset(name, {.row = layout.shape(), .chunk = layout.chunk()}).append(mark.unfinished[i]);
    }
  }
  to.commit(layout, end);
}

}  // namespace seiche
