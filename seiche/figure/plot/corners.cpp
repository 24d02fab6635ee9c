#include <seiche/figure/plot/corners.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seiche {
namespace {

// The mean angle between one state and the next along a curve, as it is seen, in radians: long pieces count more, so
// that a state at rest, whose pieces are round-off, has no say.
double mean_corner(const Series& curve, const Axis& x, const Axis& y) {
  double sum = 0, weights = 0;
  for (std::size_t i = 1; i + 1 < curve.x.size(); ++i) {
    const auto along = [](const Axis& axis, double from, double to) { return axis.place(to) - axis.place(from); };
    const double ax = along(x, curve.x[i - 1], curve.x[i]), ay = along(y, curve.y[i - 1], curve.y[i]);
    const double bx = along(x, curve.x[i], curve.x[i + 1]), by = along(y, curve.y[i], curve.y[i + 1]);
    const double weight = std::hypot(ax, ay) + std::hypot(bx, by);
    if (!std::isfinite(weight)) continue;
    sum += weight * std::abs(std::atan2(ax * by - ay * bx, ax * bx + ay * by));
    weights += weight;
  }
  return weights > 0 ? sum / weights : 0;
}

}  // namespace

std::string show_corners(std::vector<Series>& curves, const Axis& x, const Axis& y, std::size_t states) {
  constexpr double visible = std::numbers::pi / 12, meaningless = std::numbers::pi / 3;
  double corner = 0;
  for (const Series& curve : curves) corner = std::max(corner, mean_corner(curve, x, y));
  if (corner < visible) return "";
  std::size_t shown = 0;
  for (Series& curve : curves) {
    mark_all(curve);
    shown = std::max(shown, curve.x.size());
    curve.style.marker = Marker::circle;
    curve.style.size = curve.x.size() <= 400 ? 0.45 : 0.2;
    curve.style.width = 0.3;
    curve.only_markers = corner > meaningless;
  }
  std::string text = fmt::format(" Dots are the {} states that solution.h5 holds", shown);
  if (shown < states) text = fmt::format(" Dots are {} of the {} states in solution.h5", shown, states);
  text += corner > meaningless
              ? ", too far apart to be joined"
              : fmt::format(", about {:.0f} to a turn; the straight lines between them are no part of the solution",
                            2 * std::numbers::pi / corner);
  return text + (shown < states ? "." : ". A smaller output.snapshot_every or snapshot_interval leaves more states.");
}

}  // namespace seiche
