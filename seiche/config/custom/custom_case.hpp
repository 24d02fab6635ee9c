// What [problem] says where its name is "custom".
#pragma once

#include <seiche/config/custom/custom_problem.hpp>
#include <seiche/config/data/case_value.hpp>
#include <seiche/problem/problems.hpp>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace seiche {

inline constexpr const char* custom_name = "custom";
std::vector<std::string> all_problem_names();  // those of the list, and this one

// fields, parameters, H, M, V, S, D
const std::vector<std::string>& custom_keys();

// Puts the value of one of these keys into `custom`. S, M and D want `fields` and `parameters` read before.
void read_custom_key(CustomProblem& custom, const std::string& key, const CaseValue& value);

// As one of the list of problems: its parameters are those of a grid, where there is one, and the user's own with their
// values as defaults; its initial state is zero.
ProblemEntry custom_entry(const CustomProblem& custom, bool has_grid);

// Checks all formulas, with these values of the parameters and on a small grid. Throws as
// custom_problem does.
void try_formulas(const CustomProblem& custom, const ParameterValues& values);

// The keys as a case file has them; `texts` are the values of the user's parameters as written.
std::string write_custom(const CustomProblem& custom, const std::map<std::string, std::string>& texts);

// Names that no formula of the problem, and none of `others`, mentions.
std::vector<std::string> unused_parameters(const CustomProblem& custom, const std::vector<std::string>& others);

// What `seiche new custom` prints of [problem], and its line in the list of problems.
std::string example_custom();
const ProblemEntry& custom_in_list();

}  // namespace seiche
