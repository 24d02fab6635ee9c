#include <bench/scaling/figure.hpp>
#include <seiche/figure/curve_picture.hpp>

#include <algorithm>
#include <cmath>

namespace seiche::bench {
namespace {

Series series_of(const std::vector<SizeCost>& costs, double Floor::*time, const std::string& label,
                 const LineStyle& style) {
  Series series{.label = label, .style = style, .x = {}, .y = {}};
  for (const SizeCost& cost : costs) {
    series.x.push_back(static_cast<double>(cost.points));
    series.y.push_back(cost.per_point(cost.floor.*time));
  }
  return series;
}

// c log₂ N from `smallest` on, with the median c of the steps there: half of them lie above.
Series guide(const std::vector<SizeCost>& costs, Index smallest) {
  Series line{.label = "∝ log N", .style = reference_line(), .x = {}, .y = {}};
  std::vector<double> c;
  for (const SizeCost& cost : costs) {
    if (cost.points < smallest) continue;
    c.push_back(cost.per_point(cost.floor.step) / cost.levels());
    line.x.push_back(static_cast<double>(cost.points));
    line.y.push_back(cost.levels());
  }
  const auto middle = c.begin() + std::ssize(c) / 2;
  std::nth_element(c.begin(), middle, c.end());
  for (double& y : line.y) y *= *middle;
  return line;
}

}  // namespace

void draw_scaling(const std::vector<SizeCost>& costs, Index smallest, const std::filesystem::path& directory) {
  CurvePicture picture{.stem = "scaling",
                       .title = "A step and its transforms, 1-D Klein–Gordon",
                       .caption = {},
                       .x = {.label = "grid points $N$", .logarithmic = true, .powers_of_two = true},
                       .y = {.label = "ns per point and step", .logarithmic = true},
                       .series = {}};
  picture.series.push_back(series_of(costs, &Floor::step, "step of SEISAV", method_line("seisav")));
  picture.series.push_back(
      series_of(costs, &Floor::transforms, "its four transforms", {"#555555", Marker::circle, true, Dash::solid, 0.8}));
  picture.series.push_back(
      series_of(costs, &Floor::triad, "triad", {"#8C8C8C", Marker::diamond, false, Dash::dotted, 0.8}));
  picture.series.push_back(guide(costs, smallest));
  std::vector<CurvePicture> pictures = {std::move(picture)};
  draw_curves(pictures, directory);
}

}  // namespace seiche::bench
