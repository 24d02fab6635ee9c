// Characters of ASCII. Not those of <cctype>, whose answers depend on the locale.
#pragma once

#include <algorithm>
#include <string_view>

namespace seiche {

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
constexpr bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
constexpr bool begins_name(char c) { return is_letter(c) || c == '_'; }

// Without blanks and tabs at its ends.
constexpr std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  return text.substr(0, text.find_last_not_of(" \t") + 1);
}

}  // namespace seiche
