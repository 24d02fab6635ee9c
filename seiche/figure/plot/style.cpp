#include <seiche/figure/plot/style.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace seiche {
namespace {

constexpr double thin = 0.8;
constexpr double heavy = 2.4;
constexpr double heavy_on_top = 1.5;  // leaves an equal curve of the other proposed method visible at its sides

const std::vector<MethodStyle>& table() {
  using enum Marker;
  using enum Dash;
  // Sizes differ on purpose: methods with the same error would hide each other, nested markers do not, since open ones
  // are seen through and filled ones have a white rim.
  // clang-format off
  static const std::vector<MethodStyle> styles = {
      {"avf",    "AVF",    {"#707070", pentagon,      false, dashed,      thin,  2.20}, false},
      {"sav",    "SAV",    {"#A6611A", diamond,       false, dash_dotted, thin,  1.75}, false},
      {"lm",     "LM",     {"#6C8EBF", triangle_down, false, dash_dotted, thin,  1.10}, false},
      {"savf",   "SAVF",   {"#2AA198", circle,        false, dashed,      thin,  1.40}, false},
      {"ssav",   "SSAV",   {"#E69F00", square,        false, dash_dotted, thin,  1.10}, false},
      {"slm",    "SLM",    {"#3C9FD8", triangle,      false, dotted,      thin,  0.80}, false},
      {"eavf",   "EAVF",   {"#999933", pentagon,      true,  solid,       thin,  1.00}, false},
      {"eisav",  "EISAV",  {"#882255", diamond,       true,  solid,       thin,  1.00}, false},
      {"eilm",   "EILM",   {"#332288", triangle_down, true,  solid,       thin,  1.00}, false},
      {"seavf",  "SEAVF",  {"#117733", circle,        true,  solid,       thin,  1.75}, false},
      {"seidm",  "SEIDM",  {"#AA4499", star,          true,  solid,       thin,  1.00}, false},
      {"egc2",   "EGC2",   {"#B0C4A0", diamond,       true,  long_dashed, thin,  1.00}, false},
      {"egc4",   "EGC4",   {"#5E8C61", square,        true,  long_dashed, thin,  1.00}, false},
      {"egc6",   "EGC6",   {"#2F5D50", circle,        true,  long_dashed, thin,  1.00}, false},
      {"egc8",   "EGC8",   {"#0B3B2E", pentagon,      true,  long_dashed, thin,  1.00}, false},
      {"seimp",  "SEIMP",  {"#D9A5B3", diamond,       true,  dotted,      thin,  1.00}, false},
      {"etdrk4", "ETDRK4", {"#B5446E", square,        true,  dotted,      thin,  1.00}, false},
      {"crkn4",  "CRKN4",  {"#7A5C8E", triangle,      true,  dotted,      thin,  1.00}, false},
      {"crkn6",  "CRKN6",  {"#4B2E63", triangle_down, true,  dotted,      thin,  1.00}, false},
      {"strang_exact", "Strang, exact", {"#C9B458", circle, true, dotted, thin,  1.00}, false},
      {"chin4",  "Chin4",  {"#8C6D1F", pentagon,      true,  dotted,      thin,  1.00}, false},
      {"seisav", "SEISAV", {"#D55E00", square,        true,  solid,       heavy, 1.35}, true},
      {"seilm",  "SEILM",  {"#0072B2", triangle,      true,  solid,       heavy_on_top, 0.75}, true},
  };
  // clang-format on
  return styles;
}

int point_type(Marker marker, bool filled) {
  switch (marker) {
    case Marker::none: return 0;
    case Marker::star: return 3;
    case Marker::square: return filled ? 5 : 4;
    case Marker::circle: return filled ? 7 : 6;
    case Marker::triangle: return filled ? 9 : 8;
    case Marker::triangle_down: return filled ? 11 : 10;
    case Marker::diamond: return filled ? 13 : 12;
    case Marker::pentagon: return filled ? 15 : 14;
  }
  return 0;
}

std::string_view dash_type(Dash dash) {
  switch (dash) {
    case Dash::solid: return "solid";
    case Dash::dashed: return "(9,5)";
    case Dash::dash_dotted: return "(10,4,2,4)";
    case Dash::dotted: return "(2,3)";
    case Dash::long_dashed: return "(12,12)";
  }
  return "solid";
}

constexpr double unit = 0.55;  // gnuplot's size of a marker of size 1

// For curves that belong to no method.
LineStyle neutral_line(int index) {
  const auto& colours = curve_colours();
  static const std::array<Marker, 6> markers = {Marker::triangle, Marker::square,   Marker::circle,
                                                Marker::diamond,  Marker::pentagon, Marker::triangle_down};
  const auto i = static_cast<std::size_t>(index) % colours.size();
  return {.colour = colours[i], .marker = markers[i], .width = 1.1};
}

}  // namespace

const MethodStyle* find_method_style(std::string_view name) {
  const auto& styles = table();
  const auto found = std::find_if(styles.begin(), styles.end(), [&](const MethodStyle& s) { return s.name == name; });
  return found == styles.end() ? nullptr : &*found;
}

std::string method_label(std::string_view name) {
  const MethodStyle* style = find_method_style(name);
  return std::string(style ? style->label : name);
}

LineStyle method_line(std::string_view name) {
  const MethodStyle* style = find_method_style(name);
  return style ? style->line : LineStyle{.marker = Marker::circle, .filled = false};
}

std::string_view method_of_curve(std::string_view curve_name) {
  std::string word;
  for (const char c : curve_name) {
    if (std::isalpha(static_cast<unsigned char>(c)) == 0) break;
    word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  const MethodStyle* style = find_method_style(word);
  return style ? style->name : "";
}

LineStyle curve_line(std::string_view curve_name, int nth, int index) {
  const std::string_view method = method_of_curve(curve_name);
  if (method.empty()) return neutral_line(index);
  if (curve_name.find("as printed") != std::string_view::npos) nth = 2;
  LineStyle line = method_line(method);
  if (nth == 0) return line;
  line.dash = nth == 1 ? Dash::dashed : Dash::dotted;
  line.filled = line.filled == (nth > 1);
  line.size *= nth == 1 ? 1.8 : 0.7;
  line.width = 1.0;
  // Three dashes of one colour are too many to tell apart.
  if (nth > 1) line.colour = "#808080";
  return line;
}

const std::array<std::string, 6>& curve_colours() {
  static const std::array<std::string, 6> colours = {"#0072B2", "#D55E00", "#117733", "#AA4499", "#E69F00", "#707070"};
  return colours;
}

LineStyle reference_line() { return {.colour = "#000000", .width = 0.5}; }

std::string gnuplot_line(const LineStyle& style) {
  return fmt::format("lc rgb '{}' lw {} dt {}", style.colour, style.width, dash_type(style.dash));
}

std::string gnuplot_marker(const LineStyle& style) {
  return fmt::format("pt {} ps {:.3f}", point_type(style.marker, style.filled), unit * style.size);
}

std::string gnuplot_rim(const LineStyle& style) {
  constexpr double rim = 0.10;
  return fmt::format("pt {} ps {:.3f}", point_type(style.marker, style.filled), unit * style.size + rim);
}

double text_width(std::string_view text, double font_size) {
  double ems = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0U) == 0x80U) continue;  // the rest of a letter beyond ASCII
    if (std::string_view(" ,.:;|iIl()'jftr").find(c) != std::string_view::npos) {
      ems += 0.36;
    } else {
      ems += c >= 'A' && c <= 'Z' ? 0.68 : 0.61;
    }
  }
  constexpr double points_per_inch = 72;
  return ems * font_size / points_per_inch;
}

}  // namespace seiche
