// Names that the formulas of a problem written down may use for its fields and parameters.
#pragma once

#include <seiche/config/custom/custom_problem.hpp>

#include <string>
#include <vector>

namespace seiche {

// The fields, where none are given too. Throws Error for names that formulas could not tell apart.
std::vector<std::string> field_names(const CustomProblem& custom);

// Throws Error for an odd number of fields without an S.
void require_structure(const CustomProblem& custom);

}  // namespace seiche
