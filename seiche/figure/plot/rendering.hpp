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
  std::vector<std::string> formats = {"png", "pdf"};  // png, pdf, svg
};

// Commands that run `commands` once for every format, into <stem><suffix>.<format>; inches.
std::string rendered(const Rendering& rendering, std::string_view stem, double width, double height,
                     std::string_view commands);

}  // namespace seiche
