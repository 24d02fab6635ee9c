// Small pieces of HTML: text made harmless, numbers as a reader wants them, pictures as part of the page.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace seiche {

std::string html_escaped(std::string_view text);  // also safe inside attribute quotes

// 1.42·10⁻⁵ with a raised exponent, "0", "—" for what is not a finite number.
std::string html_number(double value);

// Text with its numbers like 7.3e-06 written as html_number does, each kept on one line.
std::string html_text(std::string_view text);

struct PngPicture {
  std::string data_uri;
  unsigned width = 0, height = 0;  // pixels
};
// Throws Error if the file cannot be read or is not a PNG.
PngPicture read_png(const std::filesystem::path& path);

std::string base64(std::string_view bytes);

}  // namespace seiche
