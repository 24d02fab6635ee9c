#include <seiche/figure/bars_picture.hpp>
#include <seiche/figure/plot/axis.hpp>
#include <seiche/figure/plot/symbols.hpp>
#include <seiche/figure/run_curves.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace seiche {
namespace {

constexpr std::size_t most_bars = 4000;  // more are a blot

struct Extent {
  double low = 0, high = 0;
  double size() const { return high - low; }
};

Extent extent_of(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {*low, *high};
}

// What displacements are multiplied by, so that the largest is seen: 1, or 1, 2 or 5 times a power of ten.
double magnified(double largest, double size) {
  constexpr double seen = 0.02;  // of the frame
  if (!(largest > 0) || largest >= seen * size) return 1;
  const double wanted = 2 * seen * size / largest;
  const double decade = std::pow(10, std::floor(std::log10(wanted)));
  double factor = decade;
  for (const double step : {2.0, 5.0})
    if (step * decade <= wanted) factor = step * decade;
  return factor;
}

}  // namespace

std::optional<CurvePicture> bars_picture(const RunFiles& run, const SolutionReader& solution) {
  const std::vector<std::array<Index, 2>> bars = solution.bars();
  if (bars.empty() || bars.size() > most_bars || solution.count() == 0 || solution.fields().size() < 2) return {};
  const std::vector<Place> supports = solution.supports();
  std::vector<Place> at_rest = solution.nodes();
  at_rest.insert(at_rest.end(), supports.begin(), supports.end());
  std::vector<double> x, y;
  for (const Place& place : at_rest) {
    x.push_back(place[0]);
    y.push_back(place[1]);
  }
  const double size = std::max(extent_of(x).size(), extent_of(y).size());

  const std::array<Index, 2> times = {0, solution.count() - 1};
  std::array<std::array<Vector, 2>, 2> moved;  // of the time, along the axis
  double largest = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t a = 0; a < 2; ++a) {
      solution.field(static_cast<Index>(a), times[k], moved[k][a]);
      largest = std::max(largest, moved[k][a].cwiseAbs().maxCoeff());
    }
  }
  const double factor = magnified(largest, size);

  const auto series_of = [&](std::string label, const LineStyle& style, int layer) {
    return Series{.label = std::move(label), .style = style, .x = {}, .y = {}, .layer = layer, .pairs = true};
  };
  std::vector<Series> all = {series_of("at rest", {.colour = "#8C8C8C", .width = 0.6}, 0)};
  for (const auto& bar : bars) {
    for (const Index end : bar) {
      all[0].x.push_back(x[static_cast<std::size_t>(end)]);
      all[0].y.push_back(y[static_cast<std::size_t>(end)]);
    }
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const double t = solution.time(times[k]);
    Series series = series_of(fmt::format("t = {:.4g}", t),
                              {.colour = k == 0 ? "#0072B2" : "#D55E00", .width = k == 0 ? 0.8 : 1.1}, proposed_layer);
    series.literal = at_time(t);
    for (const auto& bar : bars) {
      for (const Index end : bar) {
        const bool moves = end < solution.points();
        series.x.push_back(x[static_cast<std::size_t>(end)] + (moves ? factor * moved[k][0][end] : 0));
        series.y.push_back(y[static_cast<std::size_t>(end)] + (moves ? factor * moved[k][1][end] : 0));
      }
    }
    all.push_back(std::move(series));
  }
  Series fixed{.label = "support",
               .style = {.colour = "#000000", .marker = Marker::triangle, .filled = true, .width = 0.7, .size = 1.2},
               .x = {},
               .y = {},
               .layer = reference_layer,
               .only_markers = true};
  for (const Place& place : supports) {
    fixed.x.push_back(place[0]);
    fixed.y.push_back(place[1]);
  }
  mark_all(fixed);
  all.push_back(std::move(fixed));

  // One unit of length is as long along both axes.
  std::vector<double> xs, ys;
  for (const Series& series : all) {
    xs.insert(xs.end(), series.x.begin(), series.x.end());
    ys.insert(ys.end(), series.y.begin(), series.y.end());
  }
  const Extent across = extent_of(xs), up = extent_of(ys);
  const double unit = 1.1 * std::max({across.size() / axes_width, up.size() / axes_height, 1e-300});  // an inch
  const auto centred = [&](const Extent& extent, double inches) {
    const double middle = (extent.low + extent.high) / 2;
    return axis_between(false, middle - unit * inches / 2, middle + unit * inches / 2);
  };
  std::string caption = "The bars at the first and the last time, and at rest.";
  const std::string magnification = factor != 1 ? fmt::format(", displacements × {:g}", factor) : "";
  if (factor != 1) caption += fmt::format(" Displacements are drawn {:g} times as large as they are.", factor);
  return CurvePicture{std::move(caption), Plot{.stem = "bars",
                                               .title = title_of(run, "bars" + magnification),
                                               .x_label = symbol("x"),
                                               .y_label = symbol("y"),
                                               .x = centred(across, axes_width),
                                               .y = centred(up, axes_height),
                                               .series = std::move(all)}};
}

}  // namespace seiche
