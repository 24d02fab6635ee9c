#include <seiche/config/custom/custom_names.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/core/text/characters.hpp>

#include <fmt/ranges.h>

#include <algorithm>

namespace seiche {
namespace {

bool is_name(const std::string& name) {
  return !name.empty() && is_letter(name.front()) &&
         std::all_of(name.begin(), name.end(), [](char c) { return begins_name(c) || is_digit(c); });
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
  std::vector<std::string> derived;  // from the names of fields
  for (const std::string& name : names) {
    if (!has_place) break;
    for (const char* derivative : {"_x", "_y", "_z", "_xx", "_yy", "_zz"}) derived.push_back(name + derivative);
    derived.push_back("d" + name);
  }
  const auto take = [&](const char* key, const char* kind, const std::string& name) {
    if (!is_name(name))
      throw Error("problem.{}: '{}' is no name: letters, digits and _, a letter first{}", key, shortened(name),
                  name.find(',') != std::string::npos ? "; several names are a list, as in [\"u\", \"v\"]" : "");
    if (std::string_view(kind) == "parameter" && std::find(names.begin(), names.end(), name) != names.end())
      throw Error("problem.{}: {} is a field: give the parameter another name", key, shortened(name));
    if (std::count(names.begin(), names.end(), name) > 1)
      throw Error("problem.{}: {} is named twice: every field has a name of its own", key, shortened(name));
    if (std::find(taken.begin(), taken.end(), name) != taken.end())
      throw Error("problem.{}: the name {} stands for something else in formulas", key, shortened(name));
    if (std::find(derived.begin(), derived.end(), name) != derived.end())
      throw Error("problem.{}: {} is a derivative or difference of a field in formulas: give the {} another name", key,
                  shortened(name), kind);
    taken.push_back(name);
  };
  for (const auto& [name, value] : custom.parameters) take("parameters", "parameter", name);
  for (const std::string& name : names) take("fields", "field", name);
  return names;
}

void require_structure(const CustomProblem& custom) {
  const std::vector<std::string> names = field_names(custom);
  if (custom.S.empty() && names.size() % 2 != 0)
    throw Error(
        "problem.fields = {}: S is not given, and [[0, I], [−I, 0]] needs coordinates and as many momenta; write S, or "
        "another field",
        fmt::join(names, ", "));
}

}  // namespace seiche
