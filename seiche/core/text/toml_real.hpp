// Numbers of case files.
#pragma once

#include <fmt/format.h>

#include <string>

namespace seiche {

// The shortest that reads back the same; 2 is written 2.0.
inline std::string toml_real(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
  return text;
}

}  // namespace seiche
