// Text in CSV files (RFC 4180): quotes around it, doubled inside.
#pragma once

#include <string>
#include <string_view>

namespace seiche {

inline std::string csv_quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

// Quoted only where it holds separators.
inline std::string csv_field(std::string_view text) {
  return text.find_first_of(",\"\n") == std::string_view::npos ? std::string(text) : csv_quoted(text);
}

}  // namespace seiche
