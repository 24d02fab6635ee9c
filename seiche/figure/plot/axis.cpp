#include <seiche/figure/plot/axis.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace seiche {
namespace {

void add_tick(std::string& ticks, const std::string& label, double at, bool minor) {
  ticks += fmt::format("{}'{}' {:.17g} {}", ticks.empty() ? "" : ", ", label, at, minor ? 1 : 0);
}

// Powers of ten, not more than about seven of them labelled; with 2 and 5 times them on a short axis.
std::string decade_ticks(double low, double high) {
  const int first = static_cast<int>(std::floor(std::log10(low)));
  const int last = static_cast<int>(std::ceil(std::log10(high)));
  const double decades = std::log10(high) - std::log10(low);
  const int stride = std::max(1, static_cast<int>(std::ceil(decades / 7)));
  const auto inside = [&](double value) { return value >= low * 0.999 && value <= high * 1.001; };

  int labels = 0;
  for (int n = first; n <= last; ++n) labels += inside(std::pow(10.0, n)) ? 1 : 0;
  std::string ticks;
  for (int n = first; n <= last; ++n) {
    const double decade = std::pow(10.0, n);
    const bool labelled = n % stride == 0;
    if (inside(decade)) add_tick(ticks, labelled ? power_text(10, n) : "", decade, !labelled);
    if (stride > 1) continue;
    for (int m = 2; m <= 9; ++m) {
      if (!inside(m * decade)) continue;
      // A label at the very end would be cut off.
      const bool room =
          std::log10(m * decade / low) > 0.04 * decades && std::log10(high / (m * decade)) > 0.04 * decades;
      const bool named = labels <= 1 && room && (m == 2 || m == 5 || (decades < 0.5 && m != 9));
      add_tick(ticks, named ? fmt::format("{}·{}", m, power_text(10, n)) : "", m * decade, !named);
    }
  }
  return "(" + ticks + ")";
}

Axis with_ticks(bool logarithmic, double low, double high) {
  Axis axis{.logarithmic = logarithmic, .low = low, .high = high, .ticks = {}, .empty = false};
  if (!logarithmic) axis.linear = linear_ticks(low, high);
  axis.ticks = logarithmic ? decade_ticks(low, high) : axis.linear.ticks;
  return axis;
}

bool is_power_of_two(double value) {
  int exponent = 0;
  return value > 0 && std::frexp(value, &exponent) == 0.5;
}

}  // namespace

double Axis::place(double value) const {
  return logarithmic ? (std::log(value) - std::log(low)) / (std::log(high) - std::log(low))
                     : (value - low) / (high - low);
}

bool Axis::shows(double value) const {
  // Beyond this a margin would leave the doubles.
  constexpr double largest = 1e300;
  return std::abs(value) <= largest && (!logarithmic || value >= 1 / largest);
}

Axis fitted_axis(bool logarithmic, std::span<const double> values, double margin) {
  Axis axis{.logarithmic = logarithmic, .low = 0, .high = 0, .ticks = {}, .empty = true};
  for (const double value : values) {
    if (!axis.shows(value)) continue;
    axis.low = axis.empty ? value : std::min(axis.low, value);
    axis.high = axis.empty ? value : std::max(axis.high, value);
    axis.empty = false;
  }
  if (axis.empty) {
    axis = with_ticks(logarithmic, 0.1, 1.0);
    axis.empty = true;
    return axis;
  }
  if (logarithmic) {
    // A single value still needs an axis.
    const double factor = axis.high == axis.low ? 2.0 : std::exp(margin * (std::log(axis.high) - std::log(axis.low)));
    return with_ticks(true, axis.low / factor, axis.high * factor);
  }
  const double span = axis.high - axis.low;
  const double largest = std::max(std::abs(axis.low), std::abs(axis.high));
  const double pad = span > 1e-13 * largest ? margin * span : std::max(1.0, 0.1 * std::abs(axis.high));
  return with_ticks(false, axis.low - pad, axis.high + pad);
}

Axis axis_between(bool logarithmic, double low, double high) { return with_ticks(logarithmic, low, high); }

AxisWithZero with_zero_line(const Axis& axis) {
  const double span = axis.high / axis.low;
  AxisWithZero result{axis, axis.low / std::pow(span, 0.08)};
  result.axis.low = result.zero / std::pow(span, 0.06);
  std::string zero;
  add_tick(zero, "0", result.zero, false);
  result.axis.ticks = "(" + zero + ", " + axis.ticks.substr(1);
  return result;
}

double tick_step(double length, int ticks) {
  const double rough = length / ticks;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  return decade * (rough < 2 * decade ? 1 : rough < 5 * decade ? 2 : 5);
}

Axis axis_from_zero(double high) {
  const double step = tick_step(high, 5);  // as gnuplot's
  const double round = std::ceil(high / step) * step;
  return axis_between(false, 0, round <= 1.03 * high ? round : high);
}

bool all_powers_of_two(std::span<const double> values) {
  return !values.empty() && std::all_of(values.begin(), values.end(), is_power_of_two);
}

Axis step_size_axis(std::span<const double> step_sizes) {
  Axis axis = fitted_axis(true, step_sizes, 0.1);
  const std::set<double> sorted(step_sizes.begin(), step_sizes.end());
  constexpr std::size_t room = 8;
  if (!all_powers_of_two(step_sizes) || sorted.size() > 2 * room) return axis;
  const std::size_t stride = sorted.size() > room ? 2 : 1;
  std::string ticks;
  std::size_t i = 0;
  for (const double h : sorted) {
    const bool labelled = i++ % stride == 0;
    add_tick(ticks, labelled ? power_text(2, std::ilogb(h)) : "", h, !labelled);
  }
  axis.ticks = "(" + ticks + ")";
  return axis;
}

}  // namespace seiche
