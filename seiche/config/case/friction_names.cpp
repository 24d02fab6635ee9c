#include <seiche/config/case/friction_names.hpp>
#include <seiche/formula/formula_text.hpp>

#include <algorithm>

namespace seiche {
namespace {

bool has_one_pair(const std::vector<std::string>& fields) { return fields.size() == 2; }

}  // namespace

std::vector<std::string> friction_variables(bool has_place) {
  if (!has_place) return {"v", "u", "t", "", "", ""};
  return {"v", "u", "t", "x", "y", "z"};
}

void check_friction_names(const std::string& text, const std::vector<std::string>& fields,
                          const FormulaConstants& constants, bool has_place, const NameAdvice& advice) {
  std::vector<std::string> names = friction_variables(has_place);
  for (const std::string& field : fields)
    if (has_one_pair(fields) && std::find(names.begin(), names.end(), field) == names.end()) names.push_back(field);
  parse_formula(text, names, constants, advice);
  for (const FormulaToken& token : tokenise_formula(text)) {
    if (token.kind != FormulaToken::Kind::name) continue;
    if ((token.text == "u" || token.text == "v") && constants.contains(std::string(token.text)))
      throw formula_error(text, token.position,
                          fmt::format("{} is the {} here, and a parameter of that name is not: give the parameter "
                                      "another name",
                                      token.text, token.text == "v" ? "velocity" : "coordinate"));
    const auto field = std::find(fields.begin(), fields.end(), token.text);
    const bool is_coordinate = field - fields.begin() < std::ssize(fields) / 2;
    if (field == fields.end() || (token.text != "v" && token.text != "u") || is_coordinate == (token.text == "u"))
      continue;
    throw formula_error(text, token.position,
                        fmt::format("{} is the {} here, and a field of that name is not: give the field another name",
                                    token.text, token.text == "v" ? "velocity" : "coordinate"));
  }
}

std::string in_velocity_and_coordinate(const std::string& text, const std::vector<std::string>& fields,
                                       double inverse_mass) {
  if (!has_one_pair(fields)) return text;
  const std::string momentum = inverse_mass == 1 ? "v" : fmt::format("(v/{})", inverse_mass);
  std::string result;
  std::size_t end = 0;
  for (const FormulaToken& token : tokenise_formula(text)) {
    const bool is_name = token.kind == FormulaToken::Kind::name && token.text != "u" && token.text != "v";
    if (!is_name || (token.text != fields[0] && token.text != fields[1])) continue;
    result += text.substr(end, token.position - end);
    result += token.text == fields[0] ? "u" : momentum;
    end = token.position + token.text.size();
  }
  return result + text.substr(end);
}

}  // namespace seiche
