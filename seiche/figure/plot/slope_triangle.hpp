// The triangle that shows slope 2 in an order plot, where no curve runs.
#pragma once

#include <seiche/figure/plot/plot.hpp>

#include <optional>
#include <string>

namespace seiche {

struct SlopeTriangle {
  double x0, x1, y0, y1;  // right angle at (x1, y0)
  std::string script() const;
};

// On an axes area of the given size in inches; nothing if there is no room for one.
std::optional<SlopeTriangle> clear_slope_triangle(const Plot& plot, double width, double height);

}  // namespace seiche
