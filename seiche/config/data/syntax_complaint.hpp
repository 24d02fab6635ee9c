// What is said of a text that is no TOML.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace seiche {

// A mistake that is known (a colon for =, typographic quotes, a text that is not closed, a decimal comma), or what the
// parser `said` of `text` there, without its preamble; with the line, and what helps: quotes around a name, a fraction
// or a formula.
std::string syntax_complaint(std::string_view text, std::string_view said, std::size_t line, std::size_t column);

}  // namespace seiche
