#include <seiche/figure/gnuplot.hpp>
#include <seiche/figure/plot/map_plot.hpp>
#include <seiche/figure/plot/plot.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace seiche {
namespace {

// Inches.
constexpr double bar_room = 0.62;  // the colour bar with its numbers and its label
constexpr double bar_width = 0.09;
constexpr double below_axes = 0.40;
constexpr double between = 0.16;       // panels side by side, which share the axis y
constexpr double own_bar_room = 0.54;  // between them where each has a bar of its own
constexpr double point_height = 0.09;  // of the pointed end of a bar, beyond which there are values
constexpr double title_height = 0.17;

bool own_bars(const MapPlot& plot) {
  return std::any_of(plot.panels.begin(), plot.panels.end(), [](const MapPanel& p) { return p.colours.has_value(); });
}

struct Sizes {
  double width = 0, height = 0;  // of the axes of one panel
  double between = 0;            // panels side by side
  double picture_height = 0;
  std::size_t rows = 1;
};

Sizes sizes_of(const MapPlot& plot) {
  const auto columns = static_cast<double>(plot.in_a_row);
  Sizes sizes;
  sizes.rows = (plot.panels.size() + plot.in_a_row - 1) / plot.in_a_row;
  sizes.between = own_bars(plot) ? own_bar_room : between;
  const double right_of_all = own_bars(plot) ? own_bar_room : bar_room;
  sizes.width = (picture_width - axes_left - right_of_all - sizes.between * (columns - 1)) / columns;
  sizes.height = plot.in_a_row == 1 ? axes_height : sizes.width;
  if (plot.equal_scales) {
    double most = 0;
    for (const MapPanel& panel : plot.panels)
      most = std::max(most, (panel.y_high - panel.y_low) / (panel.x_high - panel.x_low));
    sizes.height = sizes.width * std::clamp(most, 0.3, 1.6);
  }
  const bool titled =
      std::any_of(plot.panels.begin(), plot.panels.end(), [](const MapPanel& p) { return !p.title.empty(); });
  sizes.picture_height = room_above_axes(plot.warning) +
                         static_cast<double>(sizes.rows) * (sizes.height + below_axes + (titled ? title_height : 0)) +
                         0.03;
  return sizes;
}

// A few numbers along a bar that has little room beside it: 5·10⁻⁴ instead of 0.0005.
std::string short_ticks(const ColourScale& scale) {
  const double step = tick_step(scale.high - scale.low, 3);
  std::string text;
  for (double k = std::ceil(scale.low / step - 1e-9); k * step <= scale.high * (1 + 1e-9); ++k) {
    const double value = k * step;
    const double decade = std::floor(std::log10(std::max(std::abs(value), 1e-300)) + 1e-9);
    const std::string sign = value < 0 ? "−" : "";
    const std::string size = k == 0 || std::abs(decade) < 4
                                 ? fmt::format("{:.4g}", std::abs(value))
                                 : fmt::format("{:.2g}·10^{{{}{:g}}}", std::abs(value) / std::pow(10, decade),
                                               decade < 0 ? "−" : "", std::abs(decade));
    text += fmt::format("{}'{}{}' {:.10g}", text.empty() ? "" : ", ", sign, size, value);
  }
  return "(" + text + ")";
}

// Its powers of ten stand beside every number of a short bar.
std::string offset_of(const std::string& symbol, const LinearTicks& ticks) {
  return ticks.offset.empty() ? symbol : with_unit(symbol, ticks);
}

// Significant digits that tell a thousandth of the range apart.
int digits_apart(const std::vector<double>& values) {
  constexpr int ordinary = 5, all = 17;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  const double largest = std::max(std::abs(low), std::abs(high));
  if (!(high > low)) return ordinary;
  return std::min(all, ordinary + static_cast<int>(std::ceil(std::log10(largest / (high - low)) + 0.31)));
}

std::string data_block(const MapPanel& panel, std::size_t index) {
  std::string text = fmt::format("$m{} << EOD\n", index);
  const int digits = digits_apart(panel.values);
  for (std::size_t r = 0; r < panel.rows; ++r) {
    for (std::size_t c = 0; c < panel.columns; ++c)
      fmt::format_to(std::back_inserter(text), "{:.{}g} ", panel.values[r * panel.columns + c], digits);
    text += '\n';
  }
  return text + "EOD\n";
}

std::string panel_script(const MapPlot& plot, const Sizes& sizes, std::size_t index, const Theme& theme) {
  const MapPanel& panel = plot.panels[index];
  const double title_room = panel.title.empty() ? 0 : title_height;
  const std::size_t row = index / plot.in_a_row;
  const double left = axes_left + static_cast<double>(index % plot.in_a_row) * (sizes.width + sizes.between);
  const double upper = sizes.picture_height - room_above_axes(plot.warning) - title_room -
                       static_cast<double>(row) * (sizes.height + below_axes + title_room);
  const double lower = upper - sizes.height;
  const auto across = [](double inches) { return inches / picture_width; };
  const auto up = [&](double inches) { return inches / sizes.picture_height; };
  std::string text = fmt::format(
      "unset label\nset lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\nset bmargin at screen {:.5f}\nset tmargin "
      "at screen {:.5f}\n",
      across(left), across(left + sizes.width), up(lower), up(upper));
  Axis x = axis_between(false, panel.x_low, panel.x_high), y = axis_between(false, panel.y_low, panel.y_high);
  const bool has_y_labels = index % plot.in_a_row == 0;
  if (plot.in_a_row > 1) {  // gnuplot's own number of ticks suits wide panels
    for (Axis* axis : {&x, &y}) {
      axis->linear = linear_ticks(axis->low, axis->high, 2);
      const bool is_ordinary = axis->linear.ticks == "autofreq" || (axis == &y && !has_y_labels);
      axis->ticks = is_ordinary ? fmt::format("{:.17g}", tick_step(axis->high - axis->low, 3)) : axis->linear.ticks;
    }
  }
  text += axis_script('x', x) + axis_script('y', y);
  text += fmt::format("set label {} at screen {:.5f},{:.5f} center font ',7' textcolor rgb '{}'\n",
                      with_unit(panel.x_label, x.linear), across(left + sizes.width / 2), up(lower - 0.255), theme.ink);
  if (has_y_labels) {
    if (y.linear.ticks == "autofreq") text += "set ytics format '%h'\n";
    text += fmt::format("set label {} at screen {:.5f},{:.5f} center rotate by 90 font ',7' textcolor rgb '{}'\n",
                        with_unit(panel.y_label, y.linear), across(0.12), up((lower + upper) / 2), theme.ink);
  } else {
    text += "set ytics format ''\n";
  }
  if (index == 0) {
    text += title_script(plot.title, plot.warning, picture_width, sizes.picture_height, theme);
  }
  if (panel.colours || index == 0) {
    const ColourScale& scale = panel.colours ? *panel.colours : plot.colours;
    const double bar_left = panel.colours ? left + sizes.width + 0.05 : picture_width - bar_room + 0.07;
    const double width = panel.colours ? 0.07 : bar_width;
    double bar_low = panel.colours ? lower : 0.03 + below_axes;
    double bar_high = panel.colours ? upper : sizes.picture_height - room_above_axes(plot.warning) - title_room;
    const LinearTicks ticks = linear_ticks(scale.low, scale.high);
    // Beside one bar for all there is room for words; above one of many only for the symbol.
    text += panel.colours
                ? fmt::format("set label {} at screen {:.5f},{:.5f} center font ',6.6' textcolor rgb '{}'\n",
                              plot.colour_symbol.empty() ? "''" : offset_of(plot.colour_symbol, ticks),
                              across(bar_left + width / 2), up(bar_high + 0.085), theme.ink)
                : fmt::format("set label {} at screen {:.5f},{:.5f} center rotate by 90 font ',7' textcolor rgb '{}'\n",
                              with_unit(plot.colour_label, ticks), across(picture_width - 0.08),
                              up((bar_low + bar_high) / 2), theme.ink);
    const auto point = [&](int number, double base, double tip, bool top) {
      return fmt::format(
          "set object {} polygon from screen {:.5f},{:.5f} to screen {:.5f},{:.5f} to screen {:.5f},{:.5f} to "
          "screen {:.5f},{:.5f} front fillcolor rgb '{}' fillstyle solid border lc rgb '{}' lw 0.5\n",
          number, across(bar_left), up(base), across(bar_left + width), up(base), across(bar_left + width / 2), up(tip),
          across(bar_left), up(base), palette_end(theme, scale.diverging, top), theme.ink);
    };
    if (scale.above) {
      text += point(1, bar_high - point_height, bar_high, true);
      bar_high -= point_height;
    }
    if (scale.below) {
      text += point(2, bar_low + point_height, bar_low, false);
      bar_low += point_height;
    }
    text += palette(theme, scale.diverging);
    text += fmt::format("set cbrange [{:.17g}:{:.17g}]\nset cbtics {}\n", scale.low, scale.high,
                        panel.colours && ticks.offset.empty() ? short_ticks(*panel.colours) : ticks.ticks);
    text += fmt::format("set colorbox user origin screen {:.5f},{:.5f} size screen {:.5f},{:.5f} front bdefault\n",
                        across(bar_left), up(bar_low), across(width), up(bar_high - bar_low));
  }
  if (!panel.title.empty())
    text += fmt::format("set label {} at screen {:.5f},{:.5f} center font ',6.6' textcolor rgb '{}'\n", panel.title,
                        across(left + sizes.width / 2), up(upper + 0.085), theme.ink);
  const double dx = (panel.x_high - panel.x_low) / static_cast<double>(panel.columns);
  const double dy = (panel.y_high - panel.y_low) / static_cast<double>(panel.rows);
  return text + fmt::format(
                    "plot $m{0} matrix using ({1:.10g}+{2:.10g}*($1+0.5)):({3:.10g}+{4:.10g}*($2+0.5)):3 with image\n"
                    "unset colorbox\nunset object\n",
                    index, panel.x_low, dx, panel.y_low, dy);
}

}  // namespace

ColourScale colour_scale(double low, double high) {
  if (!(high > low)) {
    const double room = std::max(std::abs(high), 1e-300);
    return low < 0 || high <= 0 ? ColourScale{-room, room, true} : ColourScale{0, 2 * room, false};
  }
  const double largest = std::max(std::abs(low), std::abs(high));
  if (low < -0.05 * largest && high > 0.05 * largest) return {-largest, largest, true};
  return {low, high, false};
}

void CommonScale::add(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  low_ = empty_ ? *low : std::min(low_, *low);
  high_ = empty_ ? *high : std::max(high_, *high);
  empty_ = false;
  for (double& value : values) value = std::abs(value);
  const auto most = values.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), most, values.end());
  most_ = std::max(most_, *most);
}

ColourScale CommonScale::scale() const {
  ColourScale scale = colour_scale(low_, high_);
  const double largest = std::max(std::abs(low_), std::abs(high_));
  if (!scale.diverging || most_ <= 0 || most_ > 0.5 * largest) return scale;
  return {-most_, most_, true, largest, high_ > most_, low_ < -most_};
}

ColourScale choose_scales(std::vector<MapPanel>& panels) {
  constexpr double much = 4;
  constexpr double round_off = 1e-9;  // of the largest
  CommonScale all;
  std::vector<double> sizes;
  std::vector<std::pair<double, double>> ranges;
  for (const MapPanel& panel : panels) {
    all.add(panel.values);
    std::vector<double> finite = panel.values;
    std::erase_if(finite, [](double value) { return !std::isfinite(value); });
    const auto [low, high] = std::minmax_element(finite.begin(), finite.end());
    ranges.push_back(finite.empty() ? std::pair(0.0, 0.0) : std::pair(*low, *high));
    sizes.push_back(std::max(std::abs(ranges.back().first), std::abs(ranges.back().second)));
  }
  const ColourScale common = all.scale();
  const double largest = sizes.empty() ? 0 : *std::max_element(sizes.begin(), sizes.end());
  double least = largest;
  for (const double size : sizes)
    if (size > round_off * largest) least = std::min(least, size);
  if (!(largest > much * least)) return common;
  // One kind of colours for all.
  bool diverging = common.diverging;
  for (std::size_t i = 0; i < panels.size(); ++i)
    if (sizes[i] > round_off * largest)
      diverging = diverging || colour_scale(ranges[i].first, ranges[i].second).diverging;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const bool visible = sizes[i] > round_off * largest;
    if (diverging) {
      const double size = visible ? sizes[i] : largest;
      panels[i].colours = ColourScale{-size, size, true};
    } else if (!visible) {
      panels[i].colours = common;
    } else {
      // From zero: what is left of a field may be nearly constant, and its round-off is no pattern.
      panels[i].colours = colour_scale(std::min(0.0, ranges[i].first), std::max(0.0, ranges[i].second));
    }
  }
  return common;
}

std::string map_script(const MapPlot& plot, const Rendering& rendering) {
  const Theme& theme = *rendering.theme;
  const Sizes sizes = sizes_of(plot);
  std::string data = "reset\nset encoding utf8\nunset key\n" + frame_script(theme);
  data += fmt::format("unset grid\nset cbtics font ',6.3' scale 0.4 offset -0.6,0 textcolor rgb '{}'\n", theme.ink);
  for (std::size_t i = 0; i < plot.panels.size(); ++i) data += data_block(plot.panels[i], i);
  std::string commands = "set multiplot\n";
  for (std::size_t i = 0; i < plot.panels.size(); ++i) commands += panel_script(plot, sizes, i, theme);
  commands += "unset multiplot\n";
  return data + rendered(rendering, plot.stem, picture_width, sizes.picture_height, commands);
}

}  // namespace seiche
