// Numbers in sentences and in case files.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace seiche {

// As fmt writes it, but for the sign of NaN, which means nothing.
inline std::string number_text(double x) { return std::isnan(x) ? "nan" : fmt::format("{}", x); }
inline std::string number_text(double x, int digits) {
  return std::isnan(x) ? "nan" : fmt::format("{:.{}g}", x, digits);
}

// As case files have it, the shortest that reads back the same; 2 is written 2.0.
inline std::string toml_real(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
  return text;
}

}  // namespace seiche
