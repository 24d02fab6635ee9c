// How a picture is put on paper: on a light or a dark ground, and in which kinds of files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace seiche {

struct Theme {
  std::string suffix;            // of file names: "" or "_dark"
  std::string paper, ink, grid;  // colours: of the ground, of text and frame, of thin lines across
  bool dark = false;

  // A colour chosen for a light ground, made light enough for a dark one.
  std::string colour(const std::string& on_light) const;
};

const Theme& light_theme();
const Theme& dark_theme();

struct Rendering {
  const Theme* theme = &light_theme();
  std::vector<std::string> formats = {"png", "pdf"};  // of picture_formats()
};

const std::vector<std::string>& picture_formats();  // png, pdf, svg

// Commands that run `commands` once for every format, into <stem><suffix>.<format>; inches.
std::string rendered(const Rendering& rendering, std::string_view stem, double width, double height,
                     std::string_view commands);

// Colours from low to high values, perceptually uniform: from both sides of zero (vik, and berlin on a dark ground), or
// from low to high (viridis). Crameri, Nature Communications 11 (2020) 5444; Smith and van der Walt, SciPy 2015.
std::string palette(const Theme& theme, bool diverging);
std::string palette_end(const Theme& theme, bool diverging, bool high);  // its first or last colour
// At s between 0 and 1 of viridis, without its ends, which would vanish on white or black: for curves in a sequence.
std::string sequence_colour(double s);

}  // namespace seiche
