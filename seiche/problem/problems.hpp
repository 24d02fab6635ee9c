// The list of problems.
#pragma once

#include <seiche/problem/common/problem_entry.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace seiche {

std::span<const ProblemEntry> problems();
std::vector<std::string> problem_names();
const ProblemEntry& find_problem(std::string_view name);  // throws Error with the nearest name

}  // namespace seiche
