// One visual language for all figures: how each method is named and drawn. Shape tells the closure (circle avf, square
// sav, triangle lm, star dm), the other shape of a pair the `whole` composition; filled and solid is exponential,
// open and dashed Cayley. Colours stay apart in print and for colour-blind readers; shapes repeat what they say.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace seiche {

enum class Marker { none, circle, square, triangle, star, pentagon, diamond, triangle_down };
enum class Dash { solid, dashed, dash_dotted, dotted, long_dashed };

std::string_view name_of(Marker marker);  // "triangle_down", as what draws knows them
std::string_view name_of(Dash dash);      // "dash_dotted"

struct LineStyle {
  std::string colour = "#000000";
  Marker marker = Marker::none;
  bool filled = true;
  Dash dash = Dash::solid;
  double width = 0.8;  // pt
};

struct MethodStyle {
  std::string_view name;   // as in the list of methods
  std::string_view label;  // as in the paper
  LineStyle line;
  bool proposed;  // one of the two methods the paper proposes: drawn last and heavier
};

// Null for a name that is not one of the methods.
const MethodStyle* find_method_style(std::string_view name);
std::string method_label(std::string_view name);  // the name itself if unknown
LineStyle method_line(std::string_view name);     // black if unknown

// For curves whose names say more than the method, as "SEISAV as printed (r frozen)". The first word decides the
// method; of several curves of one method the `nth` (from 0) keeps its colour and changes dash and filling. A scheme
// "as printed" is grey and dotted, in whatever company.
std::string_view method_of_curve(std::string_view curve_name);  // "" if the first word is no method
LineStyle curve_line(std::string_view curve_name, int nth, int index);

// Colours of curves that belong to no method, one after the other (docs/conventions.md, Pictures).
const std::array<std::string, 6>& curve_colours();

LineStyle reference_line();

}  // namespace seiche
