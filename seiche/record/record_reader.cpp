#include <seiche/core/error.hpp>
#include <seiche/record/record_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace seiche {

RecordReader::RecordReader(const std::filesystem::path& directory, SegmentsMark mark) : mark_(std::move(mark)) {
  if (mark_.unfinished.size() <= mark_.numbers()) throw Error("the mark of the segments names no field");
  for (std::size_t k = 0; k < mark_.sealed.size(); ++k) {
    const std::filesystem::path file = directory / segments_folder / segment_name(k + 1);
    segments_.emplace_back(file);
    const auto rows = static_cast<std::uint64_t>(segments_.back().count());
    if (rows != mark_.sealed[k].rows)
      throw Error("{} has {} rows, and the checkpoint vouches for {}", file.string(), rows, mark_.sealed[k].rows);
  }
}

std::vector<double> RecordReader::all(Numbers of_segment, std::size_t from_end) const {
  std::vector<double> values;
  for (const SolutionReader& segment : segments_) {
    const std::vector<double> part = (segment.*of_segment)();
    values.insert(values.end(), part.begin(), part.end());
  }
  const std::vector<double>& rest = *(mark_.unfinished.end() - 1 - static_cast<std::ptrdiff_t>(from_end));
  values.insert(values.end(), rest.begin(), rest.end());
  return values;
}

std::vector<double> RecordReader::times() const { return all(&SolutionReader::times, 0); }

std::vector<double> RecordReader::energies() const { return all(&SolutionReader::energies, mark_.numbers() - 1); }

std::vector<double> RecordReader::modified_energies() const {
  return mark_.has_modified ? all(&SolutionReader::modified_energies, 1) : std::vector<double>();
}

void RecordReader::state(Index k, Vector& values) const {
  for (const SolutionReader& segment : segments_) {
    if (k < segment.count()) return segment.state(k, values);
    k -= segment.count();
  }
  const std::size_t fields = mark_.fields();
  const auto times = static_cast<Index>(mark_.unfinished.back().size());
  if (k >= times) throw Error("there is no time {} behind {} of them", k, times);
  const Index points = static_cast<Index>(mark_.unfinished.front().size()) / times;
  values.resize(static_cast<Index>(fields) * points);
  for (std::size_t f = 0; f < fields; ++f)
    std::copy_n(mark_.unfinished[f].begin() + k * points, points, values.begin() + static_cast<Index>(f) * points);
}

}  // namespace seiche
