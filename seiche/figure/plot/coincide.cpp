#include <seiche/figure/plot/coincide.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

constexpr double line_width = 0.02;  // inches, of the heavier lines

struct Point {
  double x, y;  // inches
};

std::vector<Point> points_of(const Plot& plot, const Series& series) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
    if (!plot.x.shows(series.x[i]) || !plot.y.shows(series.y[i])) continue;
    points.push_back({plot.x.place(series.x[i]) * axes_width, plot.y.place(series.y[i]) * axes_height});
  }
  return points;
}

double distance(const Point& p, const Point& a, const Point& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double square = dx * dx + dy * dy;
  const double s = square > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - s * dx, p.y - a.y - s * dy);
}

bool is_near(const Point& p, const std::vector<Point>& line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Point& a = line[i == 0 ? 0 : i - 1];
    const Point& b = line[i];
    if (std::min(a.x, b.x) > p.x + line_width || std::max(a.x, b.x) < p.x - line_width) continue;
    if (distance(p, a, b) <= line_width) return true;
  }
  return false;
}

bool lies_on(const std::vector<Point>& points, const std::vector<Point>& line) {
  // A dip where an error changes its sign is not what tells two curves apart.
  const auto far = std::count_if(points.begin(), points.end(), [&](const Point& p) { return !is_near(p, line); });
  return 10 * far <= std::ssize(points);
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  }
  return text;
}

}  // namespace

std::vector<std::vector<std::size_t>> coinciding_series(const Plot& plot) {
  std::vector<std::vector<Point>> lines;
  for (const Series& series : plot.series) lines.push_back(points_of(plot, series));
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].empty() || plot.series[i].label.empty()) continue;
    const auto found = std::find_if(groups.begin(), groups.end(), [&](const std::vector<std::size_t>& group) {
      return std::all_of(group.begin(), group.end(),
                         [&](std::size_t k) { return lies_on(lines[i], lines[k]) && lies_on(lines[k], lines[i]); });
    });
    if (found == groups.end()) {
      groups.push_back({i});
    } else {
      found->push_back(i);
    }
  }
  std::erase_if(groups, [](const std::vector<std::size_t>& group) { return group.size() < 2; });
  return groups;
}

std::string coincidence_sentence(const Plot& plot, const std::vector<std::vector<std::size_t>>& groups) {
  if (groups.empty()) return "";
  if (groups.size() == 1 && groups[0].size() == plot.series.size()) {
    return "All curves coincide within the width of a line, all or nearly all the way.";
  }
  std::string text;
  for (const std::vector<std::size_t>& group : groups) {
    std::vector<std::string> names;
    // Names that hold commas would run into each other.
    bool quoted = false;
    for (const std::size_t i : group) quoted = quoted || plot.series[i].label.find(',') != std::string::npos;
    for (const std::size_t i : group) {
      names.push_back(quoted ? "“" + plot.series[i].label + "”" : plot.series[i].label);
    }
    text += (text.empty() ? "" : "; ") + listed(names);
  }
  return "All or nearly all the way these coincide within the width of a line: " + text + ".";
}

std::string separate(Plot& plot, const std::vector<std::vector<std::size_t>>& groups) {
  std::vector<std::string> names;
  for (const std::vector<std::size_t>& group : groups) {
    double widest = 0;
    for (const std::size_t i : group) widest = std::max(widest, plot.series[i].style.width);
    for (const std::size_t i : group) {
      Series& series = plot.series[i];
      const bool thin = series.style.width < 0.6 * widest;
      if (!thin || series.style.dash != Dash::solid || series.style.marker == Marker::none) continue;
      series.style.dash = Dash::long_dashed;
      series.style.width = std::max(series.style.width, 0.6 * widest);
      series.layer = coinciding_layer;
      names.push_back(series.label);
    }
  }
  if (names.empty()) return "";
  return fmt::format("There {} {} drawn as dashes over the thicker line.", listed(names),
                     names.size() == 1 ? "is" : "are");
}

}  // namespace seiche
