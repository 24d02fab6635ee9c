// Numbers in sentences.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace seiche {

// As fmt writes it, but for the sign of what is no number, which means nothing.
inline std::string number_text(double x) { return std::isnan(x) ? "nan" : fmt::format("{}", x); }
inline std::string number_text(double x, int digits) {
  return std::isnan(x) ? "nan" : fmt::format("{:.{}g}", x, digits);
}

}  // namespace seiche
