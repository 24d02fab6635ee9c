// What there is, as `seiche list` and the Python package say it.
#pragma once

#include <seiche/problem/problems.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace seiche {

inline constexpr std::string_view what_auto_is =
    "one of these, chosen by tolerance, stiffness, damping and friction of the case; a run says which and why";

std::vector<ProblemEntry> listed_problems();  // with the one that is written down by formulas

// What TOML's text of a value says, as JSON.
std::string json_of_toml(const std::string& text);

// Each a JSON array with an object for every entry.
std::string methods_json();
std::string problems_json();
std::string backends_json();
std::string keys_json();  // of case files, beside those of [problem] that belong to one problem

}  // namespace seiche
