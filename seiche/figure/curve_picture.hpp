// A picture of curves as plain data. Matplotlib draws it (python/seiche/drawing/curve_pictures.py).
#pragma once

#include <seiche/figure/style.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace seiche {

// Layers: the methods, those that the paper proposes, references. Higher ones are drawn later.
inline constexpr int proposed_layer = 1;
inline constexpr int reference_layer = 3;

// Of curves in a log-log picture, and others. In labels formulas stand between $, as Matplotlib has them.
struct PictureAxis {
  std::string label;
  bool logarithmic = false;
  bool powers_of_two = false;                            // its numbers are those, as of step sizes
  std::optional<std::pair<double, double>> limits = {};  // else those of the curves
};

struct Series {
  std::string label;  // "" keeps it out of the legend; plain text
  LineStyle style;
  std::vector<double> x, y;
  std::optional<std::vector<std::size_t>> marked = {};  // the points with a marker; else all
  int layer = 0;
};

// Values that are not finite are left out, and so are those that a logarithmic axis cannot show: zeros get a line of
// their own below it, and the caption says so.
struct CurvePicture {
  std::string stem;  // of the files
  std::string title;
  std::string caption;      // when it is drawn, with what curves that coincide need said
  std::string number = {};  // of the figure elsewhere that it repeats: "Figure 1, left"
  PictureAxis x, y;
  std::vector<Series> series;  // in the order of the legend
  bool slope_two = false;      // with a line of slope two below the curves
};

struct CurveFiles {
  std::vector<std::string> formats = {"png", "pdf"};
  bool dark = false;                      // also <stem>_dark.png, for a dark ground
  double width = 0;                       // inches; 0: 3.4
  bool journal = false;                   // without titles
  std::string warning = {};               // below the titles
  std::function<void()> when_drawn = {};  // called before the new files take their places
};

// Draws <stem>.png and so on; completes the captions. All of the
// pictures are there then, or none of them. Throws Error where a stem is no name of a file, and where draw() does.
void draw_curves(std::vector<CurvePicture>& pictures, const std::filesystem::path& directory,
                 const CurveFiles& files = {});

}  // namespace seiche
