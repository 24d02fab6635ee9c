#include <seiche/figure/gnuplot.hpp>
#include <seiche/figure/plot/legend.hpp>
#include <seiche/figure/plot/plot.hpp>
#include <seiche/figure/plot/slope_triangle.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace seiche {
namespace {

// Inches.
constexpr double left = axes_left;
constexpr double right = axes_right;
constexpr double below_axis = 0.35;  // tick labels and the axis label
constexpr double bottom_margin = 0.05;

constexpr double warning_height = 0.13;

constexpr double title_size = 7;

// Data blocks $name…, and the parts of the plot command that draw them; "" if nothing of it can be shown.
struct Drawing {
  std::string data;
  std::string line, markers;
};

void append_point(std::string& text, double x, double y) {
  fmt::format_to(std::back_inserter(text), "{:.17g} {:.17g}\n", x, y);
}

Drawing drawing(const Plot& plot, const Series& series, const std::string& block, const Theme& theme) {
  Drawing result;
  const auto shown = [&](std::size_t i) { return plot.x.shows(series.x[i]) && plot.y.shows(series.y[i]); };
  std::string line;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (shown(i) && !series.only_markers) append_point(line, series.x[i], series.y[i]);
    if (series.pairs && i % 2 == 1) line += '\n';  // ends a line
  }
  std::string marks;
  for (const std::size_t i : series.marked) {
    if (i < series.x.size() && shown(i)) append_point(marks, series.x[i], series.y[i]);
  }
  if (!line.empty()) {
    result.data += fmt::format("${}l << EOD\n{}EOD\n", block, line);
    result.line = fmt::format("${}l using 1:2 with lines {}, ", block, gnuplot_line(series.style));
  }
  if (!marks.empty() && series.style.marker != Marker::none) {
    result.data += fmt::format("${}m << EOD\n{}EOD\n", block, marks);
    if (series.style.filled) {
      result.markers +=
          fmt::format("${}m using 1:2 with points lc rgb '{}' {}, ", block, theme.paper, gnuplot_rim(series.style));
    }
    result.markers += fmt::format("${}m using 1:2 with points lc rgb '{}' lw {} {}, ", block, series.style.colour,
                                  std::min(series.style.width, 0.65), gnuplot_marker(series.style));
  }
  return result;
}

// A long one begins further left.
std::string line_above_axes(const std::string& text, double y, double width, const std::string& colour) {
  constexpr double edge = 0.16;
  const double widest = width - edge - right;
  const double size = title_size * std::min(1.0, widest / text_width(text, title_size));
  const double x = std::clamp(width - right - text_width(text, size), edge, left);
  return fmt::format("set label {} at screen {:.5f},{:.5f} left font ',{:.2f}' textcolor rgb '{}'\n",
                     gnuplot_text(text), x / width, y, size, colour);
}

}  // namespace

std::string frame_script(const Theme& theme) {
  return fmt::format(
      "set border 15 lw 0.5 lc rgb '{0}' front\nset tics in scale 0.55,0.3 font ',6.3' textcolor rgb '{1}'\n"
      "set grid xtics ytics lt 1 lc rgb '{2}' lw 0.4 back\nset clip two\nset minussign\n"
      "set xtics mirror offset 0,0.35\nset ytics mirror offset 0.45,0\n",
      theme.dark ? theme.ink : "#202020", theme.ink, theme.grid);
}

double room_above_axes(const std::string& warning) { return axes_top + (warning.empty() ? 0 : warning_height); }

std::string title_script(const std::string& title, const std::string& warning, double width, double height,
                         const Theme& theme) {
  std::string text = line_above_axes(title, 1 - 0.5 * axes_top / height, width, theme.ink);
  if (!warning.empty())
    text += line_above_axes(warning, 1 - (axes_top + 0.3 * warning_height) / height, width, theme.colour("#C62828"));
  return text;
}

std::string axis_script(char name, const Axis& axis) {
  std::string text;
  if (axis.logarithmic) text += fmt::format("set logscale {}\n", name);
  text += fmt::format("set {}range [{:.17g}:{:.17g}]\n", name, axis.low, axis.high);
  text += fmt::format("set {}tics {}\n", name, axis.ticks);
  if (axis.ticks == "autofreq") text += fmt::format("set m{}tics 2\n", name);
  return text;
}

void mark_all(Series& series) {
  series.marked.resize(series.x.size());
  std::iota(series.marked.begin(), series.marked.end(), std::size_t{0});
}

std::string plot_script(Plot plot, const Rendering& rendering) {
  const Theme& theme = *rendering.theme;
  for (Series& series : plot.series) series.style.colour = theme.colour(series.style.colour);
  const Legend legend(plot.series, plot.legend_room, picture_width);
  const double axes_bottom = bottom_margin + legend.height() + below_axis;
  const double above_axes = room_above_axes(plot.warning);
  const double height = axes_bottom + axes_height + above_axes;

  std::string script = "reset\nset encoding utf8\nunset key\n";
  script += fmt::format("set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n", left / picture_width,
                        1 - right / picture_width);
  script += fmt::format("set bmargin at screen {:.5f}\nset tmargin at screen {:.5f}\n", axes_bottom / height,
                        1 - above_axes / height);
  script += frame_script(theme);
  script += axis_script('x', plot.x) + axis_script('y', plot.y);
  script += title_script(plot.title, plot.warning, picture_width, height, theme);
  script += fmt::format("set label {} at screen {:.5f},{:.5f} center font ',7' textcolor rgb '{}'\n",
                        with_unit(plot.x_label, plot.x.linear), (left + axes_width / 2) / picture_width,
                        (axes_bottom - 0.245) / height, theme.ink);
  script += fmt::format("set label {} at screen {:.5f},{:.5f} center rotate by 90 font ',7' textcolor rgb '{}'\n",
                        with_unit(plot.y_label, plot.y.linear), 0.09 / picture_width,
                        (axes_bottom + axes_height / 2) / height, theme.ink);
  script += legend.script(bottom_margin + legend.height(), height, theme);
  if (plot.slope_two) {
    if (const auto triangle = clear_slope_triangle(plot, axes_width, axes_height)) script += triangle->script();
  }

  std::vector<const Series*> drawn;
  for (const Series& series : plot.series) drawn.push_back(&series);
  std::stable_sort(drawn.begin(), drawn.end(), [](const Series* a, const Series* b) { return a->layer < b->layer; });
  std::vector<Drawing> drawings;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    drawings.push_back(drawing(plot, *drawn[i], fmt::format("s{}", i), theme));
    script += drawings.back().data;
  }
  // Markers over all lines, small ones over large ones, those of references over all.
  std::vector<std::size_t> order(drawn.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rank = [&](std::size_t i) { return std::pair(drawn[i]->layer == reference_layer, -drawn[i]->style.size); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  std::string command;
  for (const Drawing& one : drawings) command += one.line;
  for (const std::size_t i : order) command += drawings[i].markers;
  if (command.empty()) {
    script += "set label 'nothing to show' at graph 0.5,0.5 center textcolor rgb '#707070'\n";
    command = "NaN";
  } else {
    command.resize(command.size() - 2);  // the last comma
  }
  return script + rendered(rendering, plot.stem, picture_width, height, "plot " + command + "\n");
}

}  // namespace seiche
