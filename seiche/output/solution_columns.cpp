#include <seiche/output/solution_columns.hpp>

#include <fmt/ranges.h>

#include <cstdint>
#include <utility>

namespace seiche {
namespace {

std::string meaning_of(const SolutionDescription& description, std::size_t field, const std::string& name) {
  return field < description.meanings.size() ? description.meanings[field] : "field " + name;
}

std::vector<Hdf5Source> sources(const std::vector<RowsOfFields>& parts, const std::string& field) {
  std::vector<Hdf5Source> all;
  for (const RowsOfFields& part : parts)
    all.push_back({.file = part.file,
                   .dataset = part.file.empty() ? fmt::format("{}/{}", rest_group, field) : field,
                   .rows = part.rows});
  return all;
}

// Every problem is stated in units of its own, so that its numbers carry none.
Hdf5Dataset make(Hdf5File& file, const std::string& name, const std::string& meaning, const Hdf5Layout& layout) {
  Hdf5Dataset data = file.make_dataset(name, layout);
  set_attribute(data.id(), "long_name", meaning);
  set_attribute(data.id(), "units", "1");
  return data;
}

std::vector<Hdf5Dataset> make_axes(Hdf5File& file, const SolutionLayout& layout) {
  std::vector<Hdf5Dataset> axes;
  for (const SolutionAxis& axis : layout.axes) {
    const bool whole = axis.name == "point";
    axes.push_back(make(file, axis.name, axis.meaning, {.chunk = {axis.values.size()}, .whole_numbers = whole}));
    axes.back().append(axis.values);
  }
  return axes;
}

// Where the points are, one by one, for readers that want the first axis to run fastest, as ParaView.
void write_mesh(Hdf5File& file, const SolutionLayout& layout) {
  const bool nodes = !layout.nodes.empty();
  const std::size_t axes = layout.axes.size();
  if (layout.mesh().empty()) return;
  file.make_group("mesh");
  const Hdf5Shape shape = layout.shape();
  Hdf5Layout rows{.row = {shape.begin() + 1, shape.end()}, .chunk = layout.chunk()};
  rows.row.push_back(3);
  rows.chunk.erase(rows.chunk.begin());
  rows.chunk.push_back(3);
  Hdf5Dataset points = make(file, layout.mesh(), "x, y and z of every point", rows);
  const std::uint64_t slab = layout.points() / shape.front();
  constexpr std::size_t enough = 1U << 16U;  // not all at once, and not one by one
  std::vector<double> listed;
  for (std::uint64_t point = 0; point < layout.points(); ++point) {
    Place place{};
    std::uint64_t rest = point;
    for (std::size_t a = axes; a-- > 0; rest /= shape[a]) place[a] = layout.axes[a].values[rest % shape[a]];
    if (nodes) place = layout.nodes[point];
    listed.insert(listed.end(), place.begin(), place.end());
    if ((point + 1) % slab != 0 || (listed.size() < enough && point + 1 < layout.points())) continue;
    points.append(listed);
    listed.clear();
  }
}

void write_bars(Hdf5File& file, const SolutionLayout& layout) {
  if (layout.bars.empty()) return;
  constexpr std::uint64_t rows = 4096;
  std::vector<double> ends, places;
  for (const auto& bar : layout.bars)
    ends.insert(ends.end(), {static_cast<double>(bar[0]), static_cast<double>(bar[1])});
  for (const Place& place : layout.supports) places.insert(places.end(), place.begin(), place.end());
  make(file, "mesh/supports", "x, y and z of the points that do not move", {.row = {3}, .chunk = {rows, 3}})
      .append(places);
  make(file, "mesh/bars", "both ends of every bar, from 0: rows of mesh/points, and behind them of mesh/supports",
       {.row = {2}, .chunk = {rows, 2}, .whole_numbers = true})
      .append(ends);
}

}  // namespace

std::vector<Hdf5Dataset> make_columns(Hdf5File& file, const SolutionLayout& layout,
                                      const SolutionDescription& description, bool has_modified_energy,
                                      const std::vector<RowsOfFields>& parts) {
  set_attribute(file.id(), "Conventions", "CF-1.10");
  for (const auto& [name, text] : description.texts) set_attribute(file.id(), name, text);
  set_attribute(file.id(), "fields", fmt::format("{}", fmt::join(layout.fields, " ")));
  for (const auto& [name, value] : {std::pair("status", "unfinished"), {"message", ""}, {"energy_law", ""}})
    set_attribute(file.id(), name, value);

  const Hdf5Layout per_time{.chunk = {1024}, .compressed = false};
  Hdf5Dataset t = make(file, "t", "time", per_time);
  const std::vector<Hdf5Dataset> axes = make_axes(file, layout);
  Hdf5Layout per_field{.row = layout.shape(), .chunk = layout.chunk()};
  std::vector<Hdf5Dataset> columns;
  for (std::size_t f = 0; f < layout.fields.size(); ++f) {
    per_field.sources = sources(parts, layout.fields[f]);
    columns.push_back(make(file, layout.fields[f], meaning_of(description, f, layout.fields[f]), per_field));
  }
  columns.push_back(make(file, "H", "energy H = ½zᵀMz + V(z), summed over points", per_time));
  if (has_modified_energy)
    columns.push_back(make(file, "H_modified", "modified energy, whose law the method keeps", per_time));
  columns.push_back(std::move(t));

  std::vector<Hdf5Axes> all;
  for (std::size_t i = 0; i + 1 < columns.size(); ++i) {
    Hdf5Axes own{&columns[i], {&columns.back()}};
    if (i < layout.fields.size())
      for (const Hdf5Dataset& axis : axes) own.scales.push_back(&axis);
    all.push_back(own);
  }
  attach_scales(file, all);
  file.flush();
  return columns;
}

std::string segment_name(std::size_t number) { return fmt::format("{:06}.h5", number); }

void write_end(Hdf5File& file, const SolutionLayout& layout, const RunReport& report) {
  write_mesh(file, layout);
  write_bars(file, layout);
  set_attribute(file.id(), "message", report.message);
  set_attribute(file.id(), "energy_law", to_string(report.law));
  set_attribute(file.id(), "status", to_string(report.status));
}

}  // namespace seiche
