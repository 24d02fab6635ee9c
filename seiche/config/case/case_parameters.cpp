#include <seiche/config/case/case_parameters.hpp>
#include <seiche/config/case/case_reading.hpp>
#include <seiche/config/custom/custom_case.hpp>
#include <seiche/config/data/initial_formulas.hpp>
#include <seiche/config/data/matrix_file.hpp>
#include <seiche/config/data/rate_formulas.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/core/text/input_file.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/formula/formula_compiler.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

namespace seiche {
namespace {

void require(const std::string& complaint) {
  if (!complaint.empty()) throw Error("problem.{}", complaint);
}

RatePointer checked_rate(const Parameter& parameter, FormulaPointer formula, TimeSpan sampled) {
  constexpr int samples = 4096;
  for (int i = 0; i <= samples; ++i) {
    const double t = sampled.begin + sampled.length * i / samples;
    const std::string complaint = out_of_bounds(parameter, (*formula)(t));
    if (!complaint.empty()) throw Error("problem.{} at t = {}", complaint, t);
  }
  return formula_rate(std::move(formula));
}

// A formula in t alone is a rate for all points. Any other is checked on the grid.
ParameterValue read_formula_rate(const std::string& key, const Parameter& parameter, const std::string& text,
                                 const RunSpec& spec) {
  const FormulaConstants constants = formula_constants(spec);
  if (FormulaPointer formula = compiled_or_null(text, {"t"}, constants))
    return checked_rate(parameter, std::move(formula), {spec.t_start, spec.duration()});
  return compile_space_rate(key, text, constants, advice_in(formula_context(spec, FormulaContext::Kind::rate)));
}

ParameterValue read_rate(const Parameter& parameter, const CaseValue& value, const RunSpec& spec) {
  const std::string key = "problem." + parameter.name;
  if (value.kind != CaseValue::Kind::number && value.kind != CaseValue::Kind::text)
    throw Error("{} = {} must be a number, or a formula in t (and x, y, z) such as \"0.1 + 0.05*sin(t)\"", key,
                value.shown());
  if (value.kind == CaseValue::Kind::text) return read_formula_rate(key, parameter, value.text, spec);
  const double gamma = read_number(key, value);
  require(out_of_bounds(parameter, gamma));
  return constant_rate(gamma);
}

// A number, or a formula in the first field.
ParameterValue read_function(const Parameter& parameter, const CaseValue& value, const RunSpec& spec) {
  const std::string key = "problem." + parameter.name;
  const std::string& field = problem_entry(spec).fields.front();
  if (value.kind != CaseValue::Kind::number && value.kind != CaseValue::Kind::text)
    throw Error("{} = {} must be a number, or a formula in {}", key, value.shown(), field);
  const FormulaConstants constants = formula_constants(spec);
  if (const FormulaPointer constant = compiled_or_null(value.text, {}, constants)) {
    const double number = (*constant)(0);
    require(out_of_bounds(parameter, number));
    return number;
  }
  try {
    return compile_state_function(value.text, field, constants);
  } catch (const Error& error) {
    throw Error("{}: {}", key, error.what());
  }
}

std::filesystem::path find_file(std::string_view what, const std::string& name, const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  for (const fs::path& candidate : {folder / name, fs::path(name)}) {  // folder / absolute is the absolute one
    const InputFile found = look_at(candidate);
    if (found.kind == InputKind::missing) continue;
    const std::string complaint = complaint_about_file(candidate);
    if (!complaint.empty()) throw Error("the {} file {} {}", what, shortened_path(candidate.string()), complaint);
    return fs::absolute(candidate).lexically_normal();
  }
  throw Error("the {} file {} does not exist, neither beside the case file nor in the current folder", what,
              shortened_path(name));
}

FormulaData read_formulas(std::string_view key, const CaseValue& value, const RunSpec& spec) {
  const ProblemEntry& problem = problem_entry(spec);
  const FormulaContext context = formula_context(spec, FormulaContext::Kind::initial);
  const NameAdvice advice = advice_in(context);
  const std::vector<std::string> places = place_variables(context.axes);
  const FormulaConstants constants = formula_constants(spec);
  FormulaData data;
  for (const auto& [field, formula] : value.entries) {
    if (formula.kind != CaseValue::Kind::text && formula.kind != CaseValue::Kind::number)
      throw Error("{}.{} = {} must be a formula in quotes, or a number", key, field, formula.shown());
    try {
      compile_formula(formula.text, places, constants, advice);
    } catch (const Error& error) {
      throw Error("{}.{}: {}", key, field, error.what());
    }
    data.formulas[field] = formula.text;
  }
  std::vector<std::string> missing = problem.fields;
  std::erase_if(missing, [&](const std::string& field) { return data.formulas.contains(field); });
  if (missing.empty()) return data;
  const bool has_zero = std::find(problem.presets.begin(), problem.presets.end(), "zero") != problem.presets.end();
  throw Error("{} has no formula for the field{} {}; write {} = 0 beside the others{}", key,
              missing.size() > 1 ? "s" : "", fmt::join(missing, ", "), fmt::join(missing, " = 0, "),
              has_zero ? ", or initial = \"zero\" for all fields" : "");
}

// Other words for what happens at the ends.
std::string boundary_meant(std::string_view word) {
  const auto is_one_of = [&](const std::vector<std::string_view>& words) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  if (is_one_of({"absorbing", "open", "outflow", "radiation", "transparent", "sponge", "pml"}))
    return "waves are absorbed by damping that grows towards the ends, as in cases/sponge_layer.toml";
  if (is_one_of({"fixed", "zero", "clamped", "Dirichlet"})) return "did you mean 'dirichlet'?";
  if (is_one_of({"free", "reflecting", "no-flux", "noflux", "Neumann"})) return "did you mean 'neumann'?";
  return is_one_of({"ring", "cyclic", "Periodic"}) ? "did you mean 'periodic'?" : "";
}

// q = 1.5, p = "0"
std::string named_values(const std::vector<std::string>& fields, const CaseValue& list) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < fields.size(); ++i)
    parts.push_back(fmt::format("{} = {}", fields[i], list.entries[i].second.shown()));
  return fmt::format("{}", fmt::join(parts, ", "));
}

// A number or name, checked, and how a case file writes it: 2 and 2.0 are one case.
std::pair<ParameterValue, std::string> read_parameter(const std::string& key, const Parameter& parameter,
                                                      const CaseValue& value) {
  if (parameter.kind == ParameterKind::choice) {
    if (parameter.name == "boundary")
      if (const std::string meant = boundary_meant(value.text); !meant.empty())
        throw Error("unknown {} '{}'; {}{} Allowed: {}", key, shortened(value.text), meant,
                    meant.ends_with('?') ? "" : ".", fmt::join(parameter.choices, ", "));
    const std::string name = read_name(key, value, parameter.choices);
    return {name, name};
  }
  const double number = read_number(key, value);
  require(out_of_bounds(parameter, number));
  if (parameter.kind == ParameterKind::real)
    return {number, is_toml_number(value.text) ? toml_real(number) : value.text};
  const long whole = read_whole(key, value, std::numeric_limits<long>::min());
  return {whole, fmt::format("{}", whole)};
}

template <class T>
std::vector<T> gathered(const std::vector<ParameterValue>& values) {
  std::vector<T> list;
  for (const ParameterValue& value : values) list.push_back(std::get<T>(value));
  return list;
}

}  // namespace

FormulaContext formula_context(const RunSpec& spec, FormulaContext::Kind kind) {
  const ProblemEntry& problem = problem_entry(spec);
  const bool is_custom = problem.name == custom_name;
  FormulaContext context{kind, problem.fields, is_custom ? 0 : 3, is_custom};
  for (const Parameter& p : problem.parameters)
    if (p.name == "length")
      context.axes = !p.per_axis ? 1
                                 : static_cast<Index>(std::max(spec.parameters.reals("length").size(),
                                                               spec.parameters.integers("points").size()));
  return context;
}

void renew_rates(RunSpec& spec) {
  for (const Parameter& parameter : problem_entry(spec).parameters) {
    if (parameter.kind != ParameterKind::rate) continue;
    const std::string text = spec.parameter_texts.at(parameter.name);
    if (!is_toml_number(text)) set_parameter(spec, parameter, default_value(text));
  }
}

std::optional<MatrixSizes> matrix_sizes(const std::string& key, const CaseValue& value,
                                        const std::filesystem::path& folder) {
  const std::string name = read_text(key, value);
  if (name.empty()) return std::nullopt;
  return seiche::matrix_sizes(find_file(key, name, folder));
}

void set_parameter(RunSpec& spec, const Parameter& parameter, const CaseValue& value,
                   const std::filesystem::path& folder) {
  const std::string key = "problem." + parameter.name;
  if (parameter.kind == ParameterKind::matrix) {
    const std::string name = read_text(key, value);
    const std::string file = name.empty() ? "" : find_file(key, name, folder).string();
    bool repeats = false;
    spec.parameters.set(parameter.name,
                        file.empty() ? nullptr : std::make_shared<const SparseMatrix>(read_matrix(file, &repeats)));
    if (repeats)
      spec.notes.push_back(fmt::format("{}: {} has several entries at one place, which add up", key,
                                       std::filesystem::path(file).filename().string()));
    spec.parameter_texts[parameter.name] = file;  // absolute: the case file is copied to where the results are
    return;
  }
  if (parameter.kind == ParameterKind::rate || parameter.kind == ParameterKind::function) {
    const bool is_rate = parameter.kind == ParameterKind::rate;
    spec.parameters.set(parameter.name,
                        is_rate ? read_rate(parameter, value, spec) : read_function(parameter, value, spec));
    spec.parameter_texts[parameter.name] = is_toml_number(value.text) ? toml_real(read_number(key, value)) : value.text;
    return;
  }
  if (!parameter.per_axis) {
    const auto [number, text] = read_parameter(key, parameter, value);
    spec.parameters.set(parameter.name, number);
    spec.parameter_texts[parameter.name] = text;
    return;
  }
  constexpr std::size_t most_axes = 3;
  const bool is_list = value.kind == CaseValue::Kind::list;
  if (is_list && (value.entries.empty() || value.entries.size() > most_axes))
    throw Error("{} has {} entries; give one value, or a list with one for each of 1 to {} axes", key,
                value.entries.size(), most_axes);
  std::vector<ParameterValue> values;
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < (is_list ? value.entries.size() : 1); ++i) {
    const auto [entry, text] = read_parameter(key, parameter, is_list ? value.entries[i].second : value);
    values.push_back(entry);
    texts.push_back(parameter.kind == ParameterKind::choice && is_list ? toml_string(text) : text);
  }
  switch (parameter.kind) {
    case ParameterKind::real: spec.parameters.set(parameter.name, gathered<double>(values)); break;
    case ParameterKind::integer: spec.parameters.set(parameter.name, gathered<long>(values)); break;
    default: spec.parameters.set(parameter.name, gathered<std::string>(values)); break;
  }
  spec.parameter_texts[parameter.name] = is_list ? fmt::format("[{}]", fmt::join(texts, ", ")) : texts.front();
}

InitialData read_initial(std::string_view key, const CaseValue& value, const RunSpec& spec,
                         const std::filesystem::path& folder) {
  const ProblemEntry& problem = problem_entry(spec);
  if (value.kind == CaseValue::Kind::text) {
    try {
      return PresetData{read_name(key, value, problem.presets)};
    } catch (const Error& error) {
      throw Error("{}; or {{ file = \"…\" }}, or formulas {{ {} = \"…\" }}", error.what(),
                  fmt::join(problem.fields, " = \"…\", "));
    }
  }
  if (value.kind == CaseValue::Kind::list && value.entries.size() == problem.fields.size())
    throw Error("{} has a value for each field: name the fields, {{ {} }}", key, named_values(problem.fields, value));
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
  if (file == value.entries.end()) return read_formulas(key, value, spec);
  if (value.entries.size() > 1) throw Error("{} is either a file or formulas, not both", key);
  return read_initial_file_name(fmt::format("{}.file", key), file->second, folder);
}

FileData read_initial_file_name(const std::string& key, const CaseValue& name, const std::filesystem::path& folder) {
  return {find_file("initial", read_text(key, name), folder)};
}

}  // namespace seiche
