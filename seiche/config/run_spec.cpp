#include <seiche/config/formula_compiler.hpp>
#include <seiche/config/initial_file.hpp>
#include <seiche/config/run_spec.hpp>
#include <seiche/core/error.hpp>
#include <seiche/problem/problems.hpp>

#include <cmath>

namespace seiche {
namespace {

bool is_constant_in_formulas(const Parameter& parameter) {
  return parameter.kind == ParameterKind::real || parameter.kind == ParameterKind::integer;
}

Vector from_formulas(const RunSpec& spec, const FormulaData& data, const Problem& problem) {
  const std::vector<std::string> variables = initial_variables(spec.problem);
  std::vector<double> arguments(2);  // x, j
  for (const Parameter& parameter : find_problem(spec.problem).parameters) {
    if (parameter.kind == ParameterKind::real) arguments.push_back(spec.parameters.real(parameter.name));
    if (parameter.kind == ParameterKind::integer)
      arguments.push_back(static_cast<double>(spec.parameters.integer(parameter.name)));
  }

  Vector z(problem.size());
  Index at = 0;
  for (const std::string& field : problem.fields) {
    const auto text = data.formulas.find(field);
    if (text == data.formulas.end()) throw Error("problem.initial has no formula for the field {}", field);
    const FormulaPointer formula = compile_formula(text->second, variables);
    for (Index i = 0; i < problem.grid.unknowns(); ++i) {
      arguments[0] = problem.grid.x(i);
      arguments[1] = static_cast<double>(i + 1);
      z[at] = (*formula)(arguments);
      if (!std::isfinite(z[at]))
        throw Error("problem.initial: {} = {} is {} at x = {} (j = {})", field, text->second, z[at], arguments[0],
                    i + 1);
      ++at;
    }
  }
  return z;
}

}  // namespace

std::vector<std::string> initial_variables(const std::string& problem) {
  std::vector<std::string> names = {"x", "j"};
  for (const Parameter& parameter : find_problem(problem).parameters)
    if (is_constant_in_formulas(parameter)) names.push_back(parameter.name);
  return names;
}

Problem make_problem(const RunSpec& spec) {
  try {
    const ProblemEntry& entry = find_problem(spec.problem);
    const auto* preset = std::get_if<PresetData>(&spec.initial);
    Problem problem = entry.make(spec.parameters, preset != nullptr ? preset->name : entry.presets.front());
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
          .backend_options = {.measure_plans = spec.measure_plans}};
}

}  // namespace seiche
