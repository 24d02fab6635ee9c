#include <seiche/config/formula_compiler.hpp>
#include <seiche/config/initial_file.hpp>
#include <seiche/config/run_spec.hpp>
#include <seiche/core/error.hpp>
#include <seiche/problem/problems.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace seiche {
namespace {

bool is_constant_in_formulas(const Parameter& parameter) {
  return parameter.kind == ParameterKind::real || parameter.kind == ParameterKind::integer;
}

// Of a parameter per axis, that of the first.
double constant_in_formulas(const ParameterValues& values, const Parameter& p) {
  if (p.kind == ParameterKind::real) return p.per_axis ? values.reals(p.name).front() : values.real(p.name);
  return static_cast<double>(p.per_axis ? values.integers(p.name).front() : values.integer(p.name));
}

constexpr std::array axis_names = {"x", "y", "z"};

std::string place(const Grid& grid, Index point) {
  std::string text;
  for (Index a = 0; a < grid.dimension(); ++a)
    text +=
        fmt::format("{}{} = {}", a > 0 ? ", " : "", axis_names[static_cast<std::size_t>(a)], grid.coordinate(point, a));
  return fmt::format("{} (j = {})", text, point + 1);
}

std::vector<std::string> variables_of(const std::string& problem, std::size_t dimension) {
  std::vector<std::string> names(axis_names.begin(), axis_names.begin() + dimension);
  names.emplace_back("j");
  for (const Parameter& parameter : find_problem(problem).parameters)
    if (is_constant_in_formulas(parameter)) names.push_back(parameter.name);
  return names;
}

Vector from_formulas(const RunSpec& spec, const FormulaData& data, const Problem& problem) {
  const Index dimension = problem.grid.dimension();
  const std::vector<std::string> variables = variables_of(spec.problem, static_cast<std::size_t>(dimension));
  std::vector<double> arguments(static_cast<std::size_t>(dimension) + 1, 0.0);  // x, y, …, j
  for (const Parameter& parameter : find_problem(spec.problem).parameters)
    if (is_constant_in_formulas(parameter)) arguments.push_back(constant_in_formulas(spec.parameters, parameter));

  Vector z(problem.size());
  Index at = 0;
  for (const std::string& field : problem.fields) {
    const auto text = data.formulas.find(field);
    if (text == data.formulas.end()) throw Error("problem.initial has no formula for the field {}", field);
    const FormulaPointer formula = compile_formula(text->second, variables);
    for (Index i = 0; i < problem.grid.unknowns(); ++i) {
      for (Index a = 0; a < dimension; ++a) arguments[static_cast<std::size_t>(a)] = problem.grid.coordinate(i, a);
      arguments[static_cast<std::size_t>(dimension)] = static_cast<double>(i + 1);
      z[at] = (*formula)(arguments);
      if (!std::isfinite(z[at]))
        throw Error("problem.initial: {} = {} is {} at {}", field, text->second, z[at], place(problem.grid, i));
      ++at;
    }
  }
  return z;
}

// γ(x, t) at every point, and at so many times up to t_end that it takes no second.
void check_field_rate(const RunSpec& spec, const Parameter& parameter, const Problem& problem) {
  const FieldRate& rate = *problem.damping.field_rate;
  std::vector<double> gamma(static_cast<std::size_t>(problem.grid.unknowns()));
  const std::size_t samples = rate.is_constant() ? 1 : std::clamp<std::size_t>((1U << 22U) / gamma.size(), 16, 4096);
  for (std::size_t i = 0; i < samples; ++i) {
    const double t = samples > 1 ? spec.t_end * static_cast<double>(i) / static_cast<double>(samples - 1) : 0.0;
    rate.values(t, gamma);
    for (std::size_t j = 0; j < gamma.size(); ++j) {
      const std::string complaint = out_of_bounds(parameter, gamma[j]);
      if (!complaint.empty())
        throw Error("problem.{} at t = {}, {}", complaint, t, place(problem.grid, static_cast<Index>(j)));
    }
  }
}

void check_field_rates(const RunSpec& spec, const Problem& problem) {
  if (!problem.damping.field_rate) return;
  for (const Parameter& parameter : find_problem(spec.problem).parameters)
    if (parameter.kind == ParameterKind::rate && spec.parameters.damping_rate(parameter.name).varying)
      check_field_rate(spec, parameter, problem);
}

}  // namespace

std::vector<std::string> initial_variables(const std::string& problem) {
  return variables_of(problem, axis_names.size());
}

Problem make_problem(const RunSpec& spec) {
  try {
    const ProblemEntry& entry = find_problem(spec.problem);
    const auto* preset = std::get_if<PresetData>(&spec.initial);
    Problem problem = entry.make(spec.parameters, preset != nullptr ? preset->name : entry.presets.front());
    check_field_rates(spec, problem);
    add_drives(spec.drives, problem);
    if (const auto* data = std::get_if<FileData>(&spec.initial))
      problem.initial = read_initial_file(data->file, problem);
    if (const auto* data = std::get_if<FormulaData>(&spec.initial))
      problem.initial = from_formulas(spec, *data, problem);
    return problem;
  } catch (const Error& error) {
    if (spec.source.empty()) throw;
    throw Error("{}: {}", spec.source, error.what());
  }
}

SimulationOptions simulation_options(const RunSpec& spec) {
  return {.method = spec.method,
          .backend = spec.backend,
          .method_options = spec.method_options,
          .backend_options = {.measure_plans = spec.measure_plans, .sparse = spec.sparse},
          .variable_steps = spec.tolerance.has_value(),
          .tolerance = spec.tolerance.value_or(0.0),
          .t_end = spec.t_end};
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

}  // namespace seiche
