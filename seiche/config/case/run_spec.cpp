#include <seiche/config/case/run_spec.hpp>
#include <seiche/config/data/initial_file.hpp>
#include <seiche/config/data/initial_formulas.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/core/text/axis_names.hpp>
#include <seiche/core/text/number_text.hpp>
#include <seiche/formula/algebra_lock.hpp>
#include <seiche/problem/common/grid_options.hpp>
#include <seiche/problem/problems.hpp>

#include <algorithm>

namespace seiche {
namespace {

// γ(x, t) at every point, and at so many times of the run that it takes no second.
void check_field_rate(const RunSpec& spec, const Parameter& parameter, const Problem& problem) {
  const FieldRate& rate = *problem.damping.field_rate;
  std::vector<double> gamma(static_cast<std::size_t>(problem.grid.unknowns()));
  const std::size_t samples =
      rate.is_constant() ? 1 : std::clamp<std::size_t>((1U << 22U) / std::max<std::size_t>(gamma.size(), 1), 16, 4096);
  for (std::size_t i = 0; i < samples; ++i) {
    const double t = samples > 1
                         ? spec.t_start + spec.duration() * static_cast<double>(i) / static_cast<double>(samples - 1)
                         : spec.t_start;
    rate.values(t, gamma);
    for (std::size_t j = 0; j < gamma.size(); ++j) {
      const std::string complaint = out_of_bounds(parameter, gamma[j]);
      if (!complaint.empty())
        throw Error("problem.{} at t = {}{}", complaint, t, place_text(problem.grid, static_cast<Index>(j)));
    }
  }
}

void check_field_rates(const RunSpec& spec, const Problem& problem) {
  if (!problem.damping.field_rate) return;
  for (const Parameter& parameter : problem_entry(spec).parameters)
    if (parameter.kind == ParameterKind::rate && spec.parameters.damping_rate(parameter.name).varying)
      check_field_rate(spec, parameter, problem);
}

// The names of files and folders in a case are written to its case.toml, which is UTF-8.
void require_utf8(const RunSpec& spec) {
  const auto require = [](std::string_view what, const std::string& name) {
    if (!is_utf8(name))
      throw Error("the name of the {} {} is not in UTF-8, as case files are: give it another one", what,
                  shortened_path(name));
  };
  require("output folder", spec.output_directory);
  require("case file", spec.source);
  if (const auto* data = std::get_if<FileData>(&spec.initial)) require("initial file", data->file.string());
  if (spec.ensemble)
    for (const std::filesystem::path& file : spec.ensemble->files) require("initial file", file.string());
  for (const auto& [name, text] : spec.parameter_texts) require("file in problem." + name, text);
}

bool begins_with_key(std::string_view complaint, std::string_view key) {
  return complaint.starts_with(key) && complaint.find_first_of(" :.,", key.size()) == key.size();
}

// Where the value of the key stands that a complaint begins with, after --set or in the file; else the file.
std::string blamed(const RunSpec& spec, std::string_view complaint) {
  constexpr std::size_t longest = 80;
  // NOLINTNEXTLINE(modernize-loop-convert): Clang 14 does not compile the ranges of GCC 12
  for (auto text = spec.overrides.rbegin(); text != spec.overrides.rend(); ++text) {
    const std::string key = text->substr(0, text->find_last_not_of(" \t", text->find('=') - 1) + 1);
    const std::size_t inside = key.find('.', key.find('.') + 1);  // a table, which is complained about as a whole
    if (begins_with_key(complaint, key.substr(0, inside))) return "--set " + shortened(*text, longest);
  }
  for (const auto& [key, place] : spec.places)
    if (begins_with_key(complaint, key)) return place;
  return shortened_path(spec.source, longest);
}

// A complaint about the rate of a parameter begins with its text, and not with its key.
std::string at_rate(const RunSpec& spec, std::string_view complaint) {
  for (const Parameter& parameter : problem_entry(spec).parameters)
    if (parameter.kind == ParameterKind::rate)
      if (const auto text = spec.parameter_texts.find(parameter.name);
          text != spec.parameter_texts.end() && complaint.starts_with("the rate " + shortened(text->second) + " "))
        return "problem." + parameter.name + ":";
  return std::string(complaint);
}

}  // namespace

const ProblemEntry& problem_entry(const RunSpec& spec) { return spec.entry ? *spec.entry : find_problem(spec.problem); }

FormulaConstants formula_constants(const RunSpec& spec) {
  FormulaConstants constants;
  std::vector<double> lengths, intervals;  // along the axes, where there are any
  Boundary boundary = Boundary::periodic;  // of the first
  bool has_ends = false;
  for (const Parameter& p : problem_entry(spec).parameters) {
    if (p.name == "boundary") {
      has_ends = true;
      boundary = boundary_named(p.per_axis ? spec.parameters.choices(p.name).front() : spec.parameters.choice(p.name));
    }
    if (p.kind != ParameterKind::real && p.kind != ParameterKind::integer) continue;
    const std::vector<double> numbers = spec.parameters.numbers(p);
    constants[p.name] = numbers.front();
    if (p.name == "length") lengths = numbers;
    if (p.name == "points") intervals = numbers;
  }
  if (lengths.empty() && has_ends) lengths = intervals;  // of a chain of masses
  if (lengths.empty() || intervals.empty()) return constants;
  const auto of_axis = [](const std::vector<double>& list, std::size_t a) {
    return list[std::min(a, list.size() - 1)];
  };
  for (std::size_t a = 0; a < std::max(lengths.size(), intervals.size()); ++a)
    constants[spacing_names[a]] = of_axis(lengths, a) / of_axis(intervals, a);
  if (!constants.contains(spacing_names[1])) constants[index_before_line] = index_at_origin(boundary);
  return constants;
}

Problem make_problem(const RunSpec& spec, const Rank& here) {
  try {
    const auto lock = algebra_lock();
    ParameterValues parameters = spec.parameters;
    parameters.here = here;
    require_utf8(spec);
    const ProblemEntry& entry = problem_entry(spec);
    const auto* preset = std::get_if<PresetData>(&spec.initial);
    Problem problem = entry.make(parameters, preset != nullptr ? preset->name : entry.presets.front());
    check_field_rates(spec, problem);
    add_drives(spec.drives, problem, formula_constants(spec));
    if (const auto* data = std::get_if<FileData>(&spec.initial))
      problem.initial = read_initial_file(data->file, problem);
    if (const auto* data = std::get_if<FormulaData>(&spec.initial))
      problem.initial = initial_from_formulas(data->formulas, formula_constants(spec), problem);
    require_finite_force(problem);
    return problem;
  } catch (const Error& error) {
    if (spec.source.empty()) throw;
    throw error.at(blamed(spec, at_rate(spec, error.what())));
  }
}

SimulationOptions simulation_options(const RunSpec& spec) {
  return {.method = spec.method,
          .backend = spec.backend,
          .method_options = spec.method_options,
          .backend_options = {.measure_plans = spec.measure_plans, .sparse = spec.sparse},
          .variable_steps = spec.tolerance.has_value(),
          .tolerance = spec.tolerance.value_or(0.0),
          .duration = spec.duration(),
          .noise = spec.noise,
          .is_of_run = true};
}

std::string objection_of(const RunSpec& spec) {
  const std::string of_noise = objection_of_noise(spec.noise);
  return of_noise.empty() ? spec.method_options.objection(find_method(spec.method)) : of_noise;
}

void refuse_noise(const RunSpec& spec, std::string_view what) {
  if (spec.noise.is_on())
    throw Error("{} looks at solutions without noise, and the case has [noise]: give --set noise.temperature=0", what);
}

std::vector<std::filesystem::path> input_files(const RunSpec& spec) {
  std::vector<std::filesystem::path> all;
  if (const auto* data = std::get_if<FileData>(&spec.initial)) all.push_back(data->file);
  for (const Parameter& parameter : problem_entry(spec).parameters) {
    if (parameter.kind != ParameterKind::matrix) continue;
    const auto text = spec.parameter_texts.find(parameter.name);
    if (text != spec.parameter_texts.end() && !text->second.empty()) all.emplace_back(text->second);
  }
  if (spec.ensemble) all.insert(all.end(), spec.ensemble->files.begin(), spec.ensemble->files.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::vector<std::string> case_notes(const RunSpec& spec, const Problem& problem) {
  std::vector<std::string> all = spec.notes;
  if (spec.h_is_default) all.insert(all.begin(), fmt::format("h = {} (default)", problem_entry(spec).default_h));
  all.insert(all.end(), problem.notes.begin(), problem.notes.end());
  return all;
}

void settle_method(RunSpec& spec) {
  if (spec.method != "auto") return;
  SimulationOptions options = simulation_options(spec);
  options.backend_options.measure_plans = false;  // nothing is timed yet, and no plan of the run is to depend on this
  const Simulation chosen(make_problem(spec), options);
  spec.method = chosen.method().name;
  spec.method_options = chosen.method_options();
  spec.notes.push_back(fmt::format("method = \"auto\": {}", chosen.reason()));
}

void settle_snapshots(RunSpec& spec, const Problem& problem) {
  if (!spec.tolerance || spec.snapshots_given) return;
  constexpr Index most_numbers = Index{1} << 24U;
  const Index numbers = problem.field_count() * problem.grid.whole().unknowns();
  Index count = numbers <= 16 ? 1024 : 512;
  while (count > 16 && count * numbers > most_numbers) count /= 2;
  spec.snapshot_interval = spec.duration() / static_cast<double>(count);  // exact, for a power of two
}

}  // namespace seiche
