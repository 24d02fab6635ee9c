#include <seiche/figure/plot/curves.hpp>
#include <seiche/figure/plot/symbols.hpp>
#include <seiche/figure/run_curves.hpp>
#include <seiche/figure/run_maps.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace seiche {
namespace {

constexpr std::size_t most_columns = 400;  // of a map: more cells are smaller than what is seen
constexpr std::size_t most_rows = 300;
constexpr Index fewest_times = 8;  // of a map over time

// An axis cut into cells around its points, so many that they are seen; `point_of` is the nearest point of a cell.
struct Cells {
  double low = 0, high = 1;
  std::vector<Index> point_of;

  Cells(const std::vector<double>& x, std::size_t most) {
    const std::size_t n = x.size();
    const double half = n > 1 ? (x.back() - x.front()) / static_cast<double>(n - 1) / 2 : 0.5;
    low = x.front() - half;
    high = x.back() + half;
    const std::size_t cells = std::min(n, most);
    for (std::size_t i = 0; i < cells; ++i) point_of.push_back(static_cast<Index>((2 * i + 1) * n / (2 * cells)));
  }
  std::size_t size() const { return point_of.size(); }
};

// Times cut into equal cells; the state nearest to the middle of each.
struct TimeCells {
  double low, high;
  std::vector<Index> state_of;

  explicit TimeCells(const std::vector<double>& t) : low(t.front()), high(t.back()) {
    for (std::size_t i = 0; i < most_columns; ++i) {
      const double wanted = low + (static_cast<double>(i) + 0.5) / most_columns * (high - low);
      const auto next = std::min(std::lower_bound(t.begin(), t.end(), wanted), t.end() - 1);
      const bool before = next != t.begin() && wanted - *(next - 1) < *next - wanted;
      state_of.push_back(next - t.begin() - (before ? 1 : 0));
    }
  }
};

ColourScale scale_of(const std::vector<MapPanel>& panels) {
  CommonScale scale;
  for (const MapPanel& panel : panels) scale.add(panel.values);
  return scale.scale();
}

// What panels with scales of their own ask to be said, or what one for all asks.
std::string scales_sentence(const MapPlot& plot) {
  if (plot.panels.empty() || !plot.panels.front().colours)
    return " All have one scale of colours." + scale_remark(plot.colours);
  return " Each has a scale of colours of its own, because the largest values differ by more than a factor of four.";
}

// A plot of one field, without panels yet.
MapPlot plot_of(const RunFiles& run, const SolutionReader& solution, Index field, const std::string& stem,
                const std::string& what) {
  const std::string& name = solution.fields()[static_cast<std::size_t>(field)];
  return {.stem = stem.empty() ? "" : stem + "_" + name,
          .title = title_of(run, in_text(name) + what),
          .colour_label = labelled(solution.meaning(field), name),
          .colour_symbol = symbol(name)};
}

// The same for planes, two in a row.
MapPlot planes_of(const RunFiles& run, const SolutionReader& solution, Index field, const std::string& stem,
                  const std::string& what) {
  MapPlot plot = plot_of(run, solution, field, stem, what);
  plot.in_a_row = 2;
  plot.equal_scales = true;
  return plot;
}

MapPicture space_time(const RunFiles& run, const SolutionReader& solution, Index field) {
  const CoordinateAxis& axis = solution.axes().front();
  const std::string& name = solution.fields()[static_cast<std::size_t>(field)];
  const TimeCells times(solution.times());
  const Cells places(axis.values, most_rows);
  MapPanel panel{.x_label = time_axis_label,
                 .y_label = axis_label(axis.name),
                 .columns = times.state_of.size(),
                 .rows = places.size(),
                 .values = std::vector<double>(times.state_of.size() * places.size()),
                 .x_low = times.low,
                 .x_high = times.high,
                 .y_low = places.low,
                 .y_high = places.high};
  Vector values;
  Index read = -1;
  for (std::size_t c = 0; c < panel.columns; ++c) {
    if (times.state_of[c] != read) solution.field(field, read = times.state_of[c], values);
    for (std::size_t r = 0; r < panel.rows; ++r) panel.values[r * panel.columns + c] = values[places.point_of[r]];
  }
  MapPlot plot = plot_of(run, solution, field, "space_time", " in space and time");
  plot.panels = {std::move(panel)};
  plot.colours = scale_of(plot.panels);
  return {fmt::format("{} over {} and t, from {} states.", in_text(name), axis.name, solution.count()) +
              scale_remark(plot.colours),
          plot};
}

// The plane of axes a < b through the middle of the others.
MapPanel plane(const SolutionReader& solution, const Vector& values, std::size_t a, std::size_t b) {
  const std::vector<CoordinateAxis>& axes = solution.axes();
  const Cells x(axes[a].values, most_rows), y(axes[b].values, most_rows);
  std::vector<Index> stride(axes.size(), 1);
  for (std::size_t i = axes.size() - 1; i-- > 0;)
    stride[i] = stride[i + 1] * static_cast<Index>(axes[i + 1].values.size());
  Index middle = 0;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (i != a && i != b) middle += stride[i] * static_cast<Index>(axes[i].values.size() / 2);
  MapPanel panel{.x_label = symbol(axes[a].name),
                 .y_label = symbol(axes[b].name),
                 .columns = x.size(),
                 .rows = y.size(),
                 .values = {},
                 .x_low = x.low,
                 .x_high = x.high,
                 .y_low = y.low,
                 .y_high = y.high};
  for (const Index j : y.point_of)
    for (const Index i : x.point_of) panel.values.push_back(values[middle + i * stride[a] + j * stride[b]]);
  return panel;
}

MapPicture slices(const RunFiles& run, const SolutionReader& solution, Index field) {
  const std::string& name = solution.fields()[static_cast<std::size_t>(field)];
  MapPlot plot = planes_of(run, solution, field, "slices", " at some times");
  Vector values;
  for (const Index k : spread(solution.count(), 4)) {
    solution.field(field, k, values);
    plot.panels.push_back(plane(solution, values, 0, 1));
    plot.panels.back().title = at_time(solution.time(k));
  }
  plot.colours = choose_scales(plot.panels);
  return {fmt::format("{} at {} times.", in_text(name), plot.panels.size()) + scales_sentence(plot), plot};
}

MapPicture middle_planes(const RunFiles& run, const SolutionReader& solution, Index field) {
  const std::string& name = solution.fields()[static_cast<std::size_t>(field)];
  MapPlot plot = planes_of(run, solution, field, "planes", " in the middle planes");
  Vector first, last;
  solution.field(field, 0, first);
  solution.field(field, solution.count() - 1, last);
  for (const auto& [a, b] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}}) {
    for (const bool start : {true, false}) {
      plot.panels.push_back(plane(solution, start ? first : last, a, b));
      plot.panels.back().title = at_time(solution.time(start ? 0 : solution.count() - 1));
    }
  }
  plot.colours = choose_scales(plot.panels);
  return {fmt::format("{} in the three planes through the middle of the box, at the first and the last time.",
                      in_text(name)) +
              scales_sentence(plot),
          plot};
}

}  // namespace

std::vector<MapPicture> solution_maps(const RunFiles& run, const SolutionReader& solution) {
  std::vector<MapPicture> all;
  const bool over_time = solution.axes().size() == 1 && solution.points() > 4 && solution.count() >= fewest_times;
  for (std::size_t f = 0; solution.count() > 0 && f < solution.fields().size(); ++f) {
    const auto field = static_cast<Index>(f);
    if (over_time && solution.times().back() > solution.times().front())
      all.push_back(space_time(run, solution, field));
    if (solution.axes().size() == 2) all.push_back(slices(run, solution, field));
    if (solution.axes().size() == 3) all.push_back(middle_planes(run, solution, field));
  }
  return all;
}

MapPlot film_frame(const RunFiles& run, const SolutionReader& solution, Index field, Index k,
                   const ColourScale& colours) {
  Vector values;
  solution.field(field, k, values);
  MapPlot plot = plot_of(run, solution, field, "", "");
  plot.warning = shortfall(run);
  plot.colours = colours;
  plot.equal_scales = true;
  plot.panels = {plane(solution, values, 0, 1)};
  plot.panels.front().title = at_time(solution.time(k));
  return plot;
}

std::string scale_remark(const ColourScale& scale) {
  return scale.beyond > 0
             ? fmt::format(
                   " The scale ends at {:.3g}, so that small values are seen; beyond its pointed ends, up to {:.3g}, "
                   "colours stay what they are at the end.",
                   scale.high, scale.beyond)
             : "";
}

ColourScale common_scale(const SolutionReader& solution, Index field, const std::vector<Index>& times) {
  CommonScale scale;
  Vector values;
  for (const Index k : times) {
    solution.field(field, k, values);
    scale.add({values.data(), values.data() + values.size()});
  }
  return scale.scale();
}

}  // namespace seiche
