#include <seiche/figure/gnuplot.hpp>
#include <seiche/figure/plot/rendering.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace seiche {
namespace {

using Colour = std::array<double, 3>;  // 0 … 255

Colour parsed(const std::string& colour) {
  Colour c{};
  for (std::size_t i = 0; i < 3; ++i) c[i] = std::stoi(colour.substr(1 + 2 * i, 2), nullptr, 16);
  return c;
}

std::string text_of(const Colour& c) {
  return fmt::format("#{:02X}{:02X}{:02X}", std::lround(c[0]), std::lround(c[1]), std::lround(c[2]));
}

Colour mixed(const Colour& a, const Colour& b, double s) {
  Colour c{};
  for (std::size_t i = 0; i < 3; ++i) c[i] = a[i] + s * (b[i] - a[i]);
  return c;
}

}  // namespace

std::string Theme::colour(const std::string& on_light) const {
  if (!dark) return on_light;
  if (on_light == "#000000") return ink;
  const Colour c = parsed(on_light);
  const double light = (0.30 * c[0] + 0.59 * c[1] + 0.11 * c[2]) / 255;
  constexpr double light_enough = 0.58;
  if (light >= light_enough) return on_light;
  return text_of(mixed(c, {255, 255, 255}, (light_enough - light) / (1 - light)));
}

const Theme& light_theme() {
  static const Theme theme{.suffix = "", .paper = "#FFFFFF", .ink = "#000000", .grid = "#DEDEDE"};
  return theme;
}

const Theme& dark_theme() {
  static const Theme theme{.suffix = "_dark", .paper = "#15181C", .ink = "#E6E8EA", .grid = "#363C44", .dark = true};
  return theme;
}

std::string rendered(const Rendering& rendering, std::string_view stem, double width, double height,
                     std::string_view commands) {
  constexpr double dots_per_inch = 300;
  constexpr double pngcairo_dots_per_inch = 96;  // what its font sizes and line widths suppose
  constexpr double scale = dots_per_inch / pngcairo_dots_per_inch;
  std::string text;
  for (const std::string& format : rendering.formats) {
    const std::string ground = fmt::format("background rgb '{}'", rendering.theme->paper);
    // The scales of the others are those that make all files look the same.
    if (format == "png") {
      text += fmt::format(
          "set terminal pngcairo enhanced size {:.0f},{:.0f} font 'DejaVu Sans,7' fontscale {:.4f} linewidth {:.4f} "
          "pointscale {:.4f} {}\n",
          width * dots_per_inch, height * dots_per_inch, scale, scale, scale, ground);
    } else if (format == "pdf") {
      text += fmt::format(
          "set terminal pdfcairo enhanced size {}in,{:.4f}in font 'DejaVu Sans,7' fontscale 0.75 linewidth 1.5 "
          "pointscale 0.75 {}\n",
          width, height, ground);
    } else {
      text +=
          fmt::format("set terminal svg enhanced size {:.0f},{:.0f} font 'DejaVu Sans,9.3' linewidth 1.2 dynamic {}\n",
                      width * pngcairo_dots_per_inch, height * pngcairo_dots_per_inch, ground);
    }
    text += fmt::format("set output {}\n{}set output\n",
                        gnuplot_file(fmt::format("{}{}.{}", stem, rendering.theme->suffix, format)), commands);
  }
  return text;
}

}  // namespace seiche
