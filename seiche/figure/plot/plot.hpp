// One picture, from curves and axes to gnuplot commands: sizes, margins, legend and slope triangle are decided here.
#pragma once

#include <seiche/figure/plot/axis.hpp>
#include <seiche/figure/plot/rendering.hpp>
#include <seiche/figure/plot/style.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace seiche {

// Of the axes area, and the margins beside it; inches.
inline constexpr double axes_width = 2.72;
inline constexpr double axes_height = 1.78;
inline constexpr double axes_top = 0.22;
inline constexpr double axes_left = 0.58;
inline constexpr double axes_right = 0.10;
inline constexpr double picture_width = axes_left + axes_width + axes_right;

// Layers: the methods, those that the paper proposes, what would vanish under these, references.
inline constexpr int proposed_layer = 1;
inline constexpr int coinciding_layer = 2;
inline constexpr int reference_layer = 3;

struct Series {
  std::string label;  // "" keeps it out of the legend
  LineStyle style;
  std::vector<double> x, y;
  std::vector<std::size_t> marked = {};  // the points with a marker
  int layer = 0;                         // higher ones are drawn later
  bool only_markers = false;             // no line between them
  bool pairs = false;                    // two points each are a line of their own
  std::string literal = {};              // of the label for gnuplot, where it is more than plain text
};

struct Plot {
  std::string stem;  // of the files
  std::string title;
  std::string warning = {};      // a line below the title, in red; "" for none
  std::string x_label, y_label;  // literals for gnuplot, see gnuplot_text
  Axis x, y;
  std::vector<Series> series;   // in the order of the legend
  bool slope_two = false;       // a triangle of slope 2, where it is clear of the curves
  std::size_t legend_room = 0;  // for at least so many entries, so that pictures side by side have one height
};

struct CurvePicture {
  std::string caption;  // for the report
  Plot plot;            // its stem names the files
};

// Draws <stem>.png and <stem>.pdf in the working directory, or what else is asked for.
std::string plot_script(Plot plot, const Rendering& rendering = {});

// What pictures of all kinds share: frame, ticks and grid in the colours of the theme; range and ticks of an axis x or
// y; a title with its warning above the left end of the axes of a picture, and the room that they take; inches.
std::string frame_script(const Theme& theme);
std::string axis_script(char name, const Axis& axis);
std::string title_script(const std::string& title, const std::string& warning, double width, double height,
                         const Theme& theme);
double room_above_axes(const std::string& warning);

void mark_all(Series& series);

}  // namespace seiche
