// Names of fields as they are set in print: u in italics, p₁ with an index, Greek letters.
#pragma once

#include <string>
#include <string_view>

namespace seiche {

// As plain text, in titles and captions: θ, l₁; other names as they are.
std::string in_text(std::string_view name);

// Literals for gnuplot, or expressions of them.
std::string symbol(std::string_view name);                              // u
std::string labelled(std::string_view meaning, std::string_view name);  // displacement u
std::string axis_label(const std::string& name);                        // x, or the word point
std::string at_time(double t);                                          // t = 2.5
inline constexpr const char* time_axis_label = "'time {/:Italic t}'";

}  // namespace seiche
