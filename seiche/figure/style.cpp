#include <seiche/figure/style.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace seiche {
namespace {

constexpr double thin = 0.8;
constexpr double heavy = 1.6;

const std::vector<MethodStyle>& table() {
  using enum Marker;
  using enum Dash;
  // clang-format off
  static const std::vector<MethodStyle> styles = {
      {"avf",    "AVF",    {"#707070", pentagon,      false, dashed,      thin}, false},
      {"sav",    "SAV",    {"#A6611A", diamond,       false, dash_dotted, thin}, false},
      {"lm",     "LM",     {"#6C8EBF", triangle_down, false, dash_dotted, thin}, false},
      {"savf",   "SAVF",   {"#2AA198", circle,        false, dashed,      thin}, false},
      {"ssav",   "SSAV",   {"#E69F00", square,        false, dash_dotted, thin}, false},
      {"slm",    "SLM",    {"#3C9FD8", triangle,      false, dotted,      thin}, false},
      {"eavf",   "EAVF",   {"#999933", pentagon,      true,  solid,       thin}, false},
      {"eisav",  "EISAV",  {"#882255", diamond,       true,  solid,       thin}, false},
      {"eilm",   "EILM",   {"#332288", triangle_down, true,  solid,       thin}, false},
      {"seavf",  "SEAVF",  {"#117733", circle,        true,  solid,       thin}, false},
      {"seidm",  "SEIDM",  {"#AA4499", star,          true,  solid,       thin}, false},
      {"egc2",   "EGC2",   {"#B0C4A0", diamond,       true,  long_dashed, thin}, false},
      {"egc4",   "EGC4",   {"#5E8C61", square,        true,  long_dashed, thin}, false},
      {"egc6",   "EGC6",   {"#2F5D50", circle,        true,  long_dashed, thin}, false},
      {"egc8",   "EGC8",   {"#0B3B2E", pentagon,      true,  long_dashed, thin}, false},
      {"seimp",  "SEIMP",  {"#D9A5B3", diamond,       true,  dotted,      thin}, false},
      {"etdrk4", "ETDRK4", {"#B5446E", square,        true,  dotted,      thin}, false},
      {"crkn4",  "CRKN4",  {"#7A5C8E", triangle,      true,  dotted,      thin}, false},
      {"crkn6",  "CRKN6",  {"#4B2E63", triangle_down, true,  dotted,      thin}, false},
      {"strang_exact", "Strang, exact", {"#C9B458", circle, true, dotted, thin}, false},
      {"chin4",  "Chin4",  {"#8C6D1F", pentagon,      true,  dotted,      thin}, false},
      {"seisav", "SEISAV", {"#D55E00", square,        true,  solid,       heavy}, true},
      {"seilm",  "SEILM",  {"#0072B2", triangle,      true,  solid,       heavy}, true},
  };
  // clang-format on
  return styles;
}

// For curves that belong to no method.
LineStyle neutral_line(int index) {
  const auto& colours = curve_colours();
  static const std::array<Marker, 6> markers = {Marker::triangle, Marker::square,   Marker::circle,
                                                Marker::diamond,  Marker::pentagon, Marker::triangle_down};
  const auto i = static_cast<std::size_t>(index) % colours.size();
  return {.colour = colours[i], .marker = markers[i], .width = 1.1};
}

}  // namespace

std::string_view name_of(Marker marker) {
  constexpr std::array<std::string_view, 8> names = {"none", "circle",   "square",  "triangle",
                                                     "star", "pentagon", "diamond", "triangle_down"};
  return names.at(static_cast<std::size_t>(marker));
}

std::string_view name_of(Dash dash) {
  constexpr std::array<std::string_view, 5> names = {"solid", "dashed", "dash_dotted", "dotted", "long_dashed"};
  return names.at(static_cast<std::size_t>(dash));
}

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

}  // namespace seiche
