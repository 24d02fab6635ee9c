// How deep a text in TOML goes, looked at before it is parsed: who parses it goes down one call for each level, and
// ends where the stack does.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace seiche {

inline constexpr int most_key_parts = 16;                            // a.b.c has three
inline constexpr int deepest_toml = 16;                              // lists and tables in each other
inline constexpr std::size_t largest_case = std::size_t{16} << 20U;  // bytes

struct TomlComplaint {
  std::string sentence;              // "" where nothing is wrong
  std::size_t line = 0, column = 0;  // of what is wrong, from 1; columns in characters
};

// Brackets and dots in texts and comments do not count. Of a text that is no TOML, what stands before its first mistake
// is looked at as a parser would.
TomlComplaint toml_depth_complaint(std::string_view text);

}  // namespace seiche
