#include <seiche/figure/plot/slope_triangle.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace seiche {
namespace {

struct Point {
  double x, y;  // inches from the lower left corner of the axes
};

// The curves as dots dense enough to measure distances by.
std::vector<Point> dots(const Plot& plot, double width, double height) {
  std::vector<Point> all;
  for (const Series& series : plot.series) {
    std::vector<Point> corners;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!plot.x.shows(series.x[i]) || !plot.y.shows(series.y[i])) continue;
      corners.push_back({plot.x.place(series.x[i]) * width, plot.y.place(series.y[i]) * height});
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      all.push_back(corners[i]);
      if (i == 0) continue;
      constexpr int pieces = 16;
      for (int k = 1; k < pieces; ++k) {
        const double s = static_cast<double>(k) / pieces;
        all.push_back({corners[i - 1].x + s * (corners[i].x - corners[i - 1].x),
                       corners[i - 1].y + s * (corners[i].y - corners[i - 1].y)});
      }
    }
  }
  return all;
}

double distance_to_box(const Point& p, double left, double right, double bottom, double top) {
  const double dx = std::max({left - p.x, p.x - right, 0.0});
  const double dy = std::max({bottom - p.y, p.y - top, 0.0});
  return std::hypot(dx, dy);
}

}  // namespace

std::string SlopeTriangle::script() const {
  std::string text = fmt::format(
      "set object polygon from {0:.8g},{2:.8g} to {1:.8g},{2:.8g} to {1:.8g},{3:.8g} to {0:.8g},{2:.8g} "
      "fillstyle solid noborder fillcolor rgb '#E4E4E4' behind\n",
      x0, x1, y0, y1);
  const auto side = [&](double xa, double ya, double xb, double yb) {
    text +=
        fmt::format("set arrow from {:.8g},{:.8g} to {:.8g},{:.8g} nohead lc rgb '#404040' lw 0.5\n", xa, ya, xb, yb);
  };
  side(x0, y0, x1, y0);
  side(x1, y0, x1, y1);
  side(x0, y0, x1, y1);
  text += fmt::format("set label '1' at {:.8g},{:.8g} center offset 0,-0.5 font ',6'\n", std::sqrt(x0 * x1), y0);
  text += fmt::format("set label '2' at {:.8g},{:.8g} left offset 0.5,0 font ',6'\n", x1, std::sqrt(y0 * y1));
  return text;
}

std::optional<SlopeTriangle> clear_slope_triangle(const Plot& plot, double width, double height) {
  if (!plot.x.logarithmic || !plot.y.logarithmic || plot.x.empty || plot.y.empty) return {};
  const std::vector<Point> curves = dots(plot, width, height);
  constexpr double label = 0.13;      // inches beside and below the triangle
  constexpr double edge = 0.07;       // from the frame
  constexpr double clear = 0.07;      // from the curves
  constexpr double far_enough = 0.3;  // from where on more distance is no better
  std::optional<SlopeTriangle> best;
  // One octave; two where that would be too small to see.
  for (const double factor : {4.0, 2.0}) {
    const double w = width * std::log(factor) / std::log(plot.x.high / plot.x.low);
    const double h = height * 2 * std::log(factor) / std::log(plot.y.high / plot.y.low);
    if (w > 0.4 * width || h > 0.45 * height) continue;
    double best_score = clear;
    constexpr int steps = 48;
    for (int i = 0; i <= steps; ++i) {
      for (int k = 0; k <= steps; ++k) {
        const double x = edge + (width - 2 * edge - label - w) * i / steps;
        const double y = edge + label + (height - 2 * edge - label - h) * k / steps;
        double nearest = std::numeric_limits<double>::infinity();
        for (const Point& p : curves)
          nearest = std::min(nearest, distance_to_box(p, x, x + w + label, y - label, y + h));
        if (nearest < clear) continue;
        // Among the places that are far enough: to the right and low, where the eye looks for it.
        const double score = std::min(nearest, far_enough) + 0.05 * (x / width - y / height);
        if (score <= best_score) continue;
        best_score = score;
        const double x0 = plot.x.low * std::pow(plot.x.high / plot.x.low, x / width);
        const double y0 = plot.y.low * std::pow(plot.y.high / plot.y.low, y / height);
        best = SlopeTriangle{x0, x0 * factor, y0, y0 * factor * factor};
      }
    }
    if (best) return best;
  }
  return best;
}

}  // namespace seiche
