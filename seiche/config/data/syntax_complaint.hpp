// What is said of a text that is no TOML.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace seiche {

// What the parser `said` of `text` there, without its preamble, and the line; where the value looks like a name, a
// fraction or a formula that lacks its quotes, that it needs them.
std::string syntax_complaint(std::string_view text, std::string_view said, std::size_t line, std::size_t column);

}  // namespace seiche
