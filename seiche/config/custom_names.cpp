#include <seiche/config/custom_problem.hpp>
#include <seiche/core/error.hpp>

#include <algorithm>

namespace seiche {
namespace {

bool is_name(const std::string& name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  return !name.empty() && letter(name.front()) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || digit(c) || c == '_'; });
}

}  // namespace

std::vector<std::string> field_names(const CustomProblem& custom) {
  const bool has_place = custom.grid.has_value();
  std::vector<std::string> names = custom.fields;
  if (names.empty()) names = has_place ? std::vector<std::string>{"u", "v"} : std::vector<std::string>{"q", "p"};
  constexpr std::size_t most_fields = 64;
  if (names.size() > most_fields)
    throw Error("problem.fields has {} names; at most {} are possible", names.size(), most_fields);
  std::vector<std::string> taken = {"pi", "Pi", "t", "j", "e", "file"};
  if (has_place) taken.insert(taken.end(), {"x", "y", "z", "dx", "dy", "dz", "laplacian", "d_x", "d_y", "d_z"});
  for (const FormulaFunction& function : formula_functions()) taken.emplace_back(function.name);
  for (const auto& [name, value] : custom.parameters) {
    if (!is_name(name)) throw Error("problem.parameters: '{}' is no name: letters, digits and _, a letter first", name);
    if (std::find(taken.begin(), taken.end(), name) != taken.end())
      throw Error("problem.parameters: the name {} stands for something else in formulas", name);
    taken.push_back(name);
  }
  for (const std::string& name : names) {
    if (!is_name(name)) throw Error("problem.fields: '{}' is no name: letters, digits and _, a letter first", name);
    if (std::find(taken.begin(), taken.end(), name) != taken.end())
      throw Error("problem.fields: the name {} stands for something else in formulas", name);
    taken.push_back(name);
    if (!has_place) continue;
    for (const char* derivative : {"_x", "_y", "_z", "_xx", "_yy", "_zz"}) taken.push_back(name + derivative);
    taken.push_back("d" + name);
  }
  return names;
}

}  // namespace seiche
