// Formulas written as in NumPy, MATLAB, C, LaTeX or on paper: what to write here instead.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace seiche {

// "write asin( )" for arcsin; "" for a name that says nothing.
std::string_view spelling_here(std::string_view name);

// "; write abs( )" for the | at this place of the text, or "". `names`: what the formula may name.
std::string advice_on_character(std::string_view text, std::size_t at, std::string_view character,
                                std::string_view name_before, const std::vector<std::string>& names);

}  // namespace seiche
