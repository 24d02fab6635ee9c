#include <seiche/config/case_parameters.hpp>
#include <seiche/config/formula_compiler.hpp>
#include <seiche/core/error.hpp>
#include <seiche/damping/rates.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

namespace seiche {
namespace {

void require(const std::string& complaint) {
  if (!complaint.empty()) throw Error("problem.{}", complaint);
}

RatePointer read_rate(const Parameter& parameter, const CaseValue& value, double t_end) {
  const std::string key = "problem." + parameter.name;
  if (value.kind != CaseValue::Kind::number && value.kind != CaseValue::Kind::text)
    throw Error("{} = {} must be a number, or a formula in t such as \"0.1 + 0.05*sin(t)\"", key, value.shown());
  if (value.kind == CaseValue::Kind::number) {
    const double gamma = read_number(key, value);
    require(out_of_bounds(parameter, gamma));
    return constant_rate(gamma);
  }
  FormulaPointer formula;
  try {
    formula = compile_formula(value.text, {"t"});
  } catch (const Error& error) {
    throw Error("{}: {}", key, error.what());
  }
  constexpr int samples = 4096;
  for (int i = 0; i <= samples; ++i) {
    const double t = t_end * i / samples;
    const std::string complaint = out_of_bounds(parameter, (*formula)(t));
    if (!complaint.empty()) throw Error("problem.{} at t = {}", complaint, t);
  }
  return formula_rate(std::move(formula));
}

std::filesystem::path find_file(const std::string& name, const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  for (const fs::path& candidate : {folder / name, fs::path(name)}) {  // folder / absolute is the absolute one
    if (fs::is_directory(candidate)) throw Error("the initial file {} is a folder", candidate.string());
    if (fs::exists(candidate)) return fs::absolute(candidate).lexically_normal();
  }
  throw Error("the initial file {} does not exist, neither beside the case file nor in the current folder", name);
}

FormulaData read_formulas(std::string_view key, const CaseValue& value, const ProblemEntry& problem) {
  FormulaData data;
  for (const auto& [field, formula] : value.entries) {
    if (formula.kind != CaseValue::Kind::text && formula.kind != CaseValue::Kind::number)
      throw Error("{}.{} = {} must be a formula in quotes, or a number", key, field, formula.shown());
    try {
      compile_formula(formula.text, initial_variables(problem.name));
    } catch (const Error& error) {
      throw Error("{}.{}: {}", key, field, error.what());
    }
    data.formulas[field] = formula.text;
  }
  for (const std::string& field : problem.fields)
    if (!data.formulas.contains(field))
      throw Error("{} has no formula for the field {}; write for example {} = \"0\"", key, field, field);
  return data;
}

}  // namespace

void set_parameter(RunSpec& spec, const Parameter& parameter, const CaseValue& value) {
  const std::string key = "problem." + parameter.name;
  std::string text = value.text;
  switch (parameter.kind) {
    case ParameterKind::real: {
      const double number = read_number(key, value);
      require(out_of_bounds(parameter, number));
      spec.parameters.set(parameter.name, number);
      break;
    }
    case ParameterKind::integer: {
      const double number = read_number(key, value);
      require(out_of_bounds(parameter, number));
      const long whole = read_whole(key, value, std::numeric_limits<long>::min());
      spec.parameters.set(parameter.name, whole);
      text = fmt::format("{}", whole);
      break;
    }
    case ParameterKind::rate: spec.parameters.set(parameter.name, read_rate(parameter, value, spec.t_end)); break;
    case ParameterKind::choice:
      text = read_name(key, value, parameter.choices);
      spec.parameters.set(parameter.name, text);
      break;
  }
  const bool is_real = parameter.kind == ParameterKind::real || parameter.kind == ParameterKind::rate;
  if (is_real && is_toml_number(text)) text = toml_real(read_number(key, value));  // 2 and 2.0 are one case
  spec.parameter_texts[parameter.name] = text;
}

InitialData read_initial(std::string_view key, const CaseValue& value, const ProblemEntry& problem,
                         const std::filesystem::path& folder) {
  if (value.kind == CaseValue::Kind::text) {
    try {
      return PresetData{read_name(key, value, problem.presets)};
    } catch (const Error& error) {
      throw Error("{}; or {{ file = \"…\" }}, or formulas {{ {} = \"…\" }}", error.what(),
                  fmt::join(problem.fields, " = \"…\", "));
    }
  }
  if (value.kind != CaseValue::Kind::table) {
    throw Error("{} = {} must be a preset ({}), {{ file = \"…\" }}, or formulas {{ {} = \"…\" }}", key, value.shown(),
                fmt::join(problem.presets, ", "), fmt::join(problem.fields, " = \"…\", "));
  }
  std::vector<std::string> names = problem.fields;
  names.emplace_back("file");
  for (const auto& [name, entry] : value.entries)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw unknown_name(fmt::format("key in {}", key), name, names);

  const auto file =
      std::find_if(value.entries.begin(), value.entries.end(), [](const auto& e) { return e.first == "file"; });
  if (file == value.entries.end()) return read_formulas(key, value, problem);
  if (value.entries.size() > 1) throw Error("{} is either a file or formulas, not both", key);
  return FileData{find_file(read_text(fmt::format("{}.file", key), file->second), folder)};
}

}  // namespace seiche
