// write_case and example_case: the same layout, the second with every meaning and bound beside its key.
#include <seiche/config/case/case_writer.hpp>
#include <seiche/config/case/key_rows.hpp>
#include <seiche/config/custom/custom_case.hpp>
#include <seiche/config/data/case_value.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/problem/problems.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

std::string number_or_string(const std::string& text) { return is_toml_number(text) ? text : toml_string(text); }

std::string initial_text(const InitialData& initial) {
  if (const auto* preset = std::get_if<PresetData>(&initial)) return toml_string(preset->name);
  if (const auto* data = std::get_if<FileData>(&initial))
    return fmt::format("{{ file = {} }}", toml_string(data->file.string()));
  std::vector<std::string> entries;
  for (const auto& [field, formula] : std::get<FormulaData>(initial).formulas)
    entries.push_back(fmt::format("{} = {}", field, toml_string(formula)));
  return fmt::format("{{ {} }}", fmt::join(entries, ", "));
}

std::string bounds(const Parameter& p) {
  std::vector<std::string> parts;
  if (p.kind == ParameterKind::integer) parts.emplace_back("whole");
  if (p.kind == ParameterKind::rate) parts.emplace_back("a number, or a formula in t (and x, y, z) in quotes");
  if (p.kind == ParameterKind::function) parts.emplace_back("a number, or a formula in quotes");
  if (std::isfinite(p.minimum)) parts.push_back(fmt::format("{} {}", p.minimum_excluded ? ">" : "≥", p.minimum));
  if (std::isfinite(p.maximum)) parts.push_back(fmt::format("≤ {}", p.maximum));
  if (p.kind == ParameterKind::choice) parts.push_back(fmt::format("\"{}\"", fmt::join(p.choices, "\" | \"")));
  if (p.per_axis) parts.emplace_back("one, or a list for several axes");
  return parts.empty() ? "" : fmt::format(" ({})", fmt::join(parts, ", "));
}

std::string parameter_literal(const Parameter& parameter, const std::string& text) {
  if (parameter.per_axis && text.starts_with('[')) return text;
  const bool is_text = parameter.kind == ParameterKind::choice || parameter.kind == ParameterKind::matrix;
  return is_text ? toml_string(text) : number_or_string(text);
}

// "key = value" with the comment in one column.
std::string line(const std::string& key, const std::string& value, const std::string& comment) {
  return fmt::format("{:<34}# {}\n", fmt::format("{} = {}", key, value), comment);
}

std::string example_of(const KeyRow& row, const ProblemEntry& problem) {
  if (!row.example.empty()) return row.example;
  if (row.name == "h") return number_or_string(problem.default_h);
  if (row.name == "end") return toml_real(problem.default_end);
  return toml_string(row.name == "directory" ? "out/" + problem.name : problem.default_method);
}

// What follows [problem]. [ensemble] is a comment: with it a case is many runs.
std::string example_sections(const ProblemEntry& problem) {
  std::string text;
  for (const std::string& section : case_sections()) {
    if (section == "problem") continue;
    text += section == "ensemble" ? "\n# [ensemble]                      # many runs at once, which leave statistics\n"
                                  : fmt::format("\n[{}]\n", section);
    for (const KeyRow& row : key_rows())
      if (row.section == section)
        text += line((row.is_default ? "" : "# ") + row.name, example_of(row, problem), row.meaning);
  }
  const auto varies = std::find_if(problem.parameters.begin(), problem.parameters.end(), may_vary);
  if (varies != problem.parameters.end())
    text += line("# " + varies->name, "{ from = 0.1, to = 0.2 }",
                 "any number of [problem]; or { uniform = [0.1, 0.2] }, { normal = [0.1, 0.01] }");
  return text + line("# initial", "{ files = [\"a.txt\", \"b.txt\"] }", "a state for each member");
}

}  // namespace

std::string write_case(const RunSpec& spec) {
  std::string text = fmt::format("[problem]\nname = {}\n", toml_string(spec.problem));
  if (spec.custom) text += write_custom(*spec.custom, spec.parameter_texts);
  for (const Parameter& parameter : problem_entry(spec).parameters) {
    if (spec.custom && spec.custom->parameters.contains(parameter.name)) continue;  // written already
    const auto value = spec.parameter_texts.find(parameter.name);
    if (value == spec.parameter_texts.end()) throw Error("the case has no parameter {}", parameter.name);
    text += fmt::format("{} = {}\n", parameter.name, parameter_literal(parameter, value->second));
  }
  text += fmt::format("initial = {}\n", initial_text(spec.initial));
  text += write_drives(spec.drives);

  std::string section = "problem";
  for (const KeyRow& row : key_rows()) {
    const std::string value = row.write ? row.write(spec) : "";
    if (value.empty()) continue;
    if (row.section != section) text += fmt::format("\n[{}]\n", row.section);
    section = row.section;
    text += fmt::format("{} = {}\n", row.name, value);
  }
  if (spec.ensemble) text += write_ensemble(*spec.ensemble);
  return text;
}

std::string case_in_any_folder(RunSpec spec) {
  spec.output_directory = std::string(".");  // GCC 12 sees an overflow in the assignment of a literal
  if (auto* data = std::get_if<FileData>(&spec.initial)) data->file = data->file.filename();
  for (const Parameter& parameter : problem_entry(spec).parameters)
    if (const auto text = spec.parameter_texts.find(parameter.name);
        parameter.kind == ParameterKind::matrix && text != spec.parameter_texts.end())
      text->second = std::filesystem::path(text->second).filename().string();
  if (spec.ensemble)
    for (std::filesystem::path& file : spec.ensemble->files) file = file.filename();
  return write_case(spec);
}

std::string example_case(const std::string& problem) {
  if (problem == custom_name) return example_custom() + example_drives() + example_sections(custom_in_list());
  const std::vector<std::string> names = all_problem_names();
  if (std::find(names.begin(), names.end(), problem) == names.end()) throw unknown_name("problem", problem, names);
  const ProblemEntry& entry = find_problem(problem);
  std::string text = fmt::format("# {}\n# {}\n\n[problem]\n", entry.equation, entry.reference);
  text += fmt::format("name = {}\n", toml_string(entry.name));
  for (const Parameter& parameter : entry.parameters) {
    text += line(parameter.name, parameter_literal(parameter, parameter.default_value),
                 parameter.meaning + bounds(parameter));
  }
  std::vector<std::string> formulas;
  for (const std::string& field : entry.fields) formulas.push_back(fmt::format("{} = \"0\"", field));
  text += line("initial", toml_string(entry.presets.front()),
               fmt::format("{}; or {{ file = \"z0.txt\" }}; or formulas in x (y, z), j: {{ {} }}",
                           fmt::join(entry.presets, " | "), fmt::join(formulas, ", ")));
  text += example_drives();

  return text + example_sections(entry);
}

}  // namespace seiche
