#include <seiche/config/data/initial_formulas.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/core/text/axis_names.hpp>
#include <seiche/core/text/number_text.hpp>
#include <seiche/core/truncated_potential.hpp>
#include <seiche/formula/formula_compiler.hpp>

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

namespace seiche {

std::vector<std::string> place_variables(Index axes) {
  std::vector<std::string> names(axis_names.begin(), axis_names.begin() + axes);
  names.emplace_back("j");
  return names;
}

std::string place_text(const Grid& grid, Index point) {
  if (grid.only_numbers && grid.nodes.empty()) return grid.unknowns() == 1 ? "" : fmt::format(" at j = {}", point + 1);
  std::string text = " at ";
  for (Index a = 0; a < grid.dimension(); ++a)
    text +=
        fmt::format("{}{} = {}", a > 0 ? ", " : "", axis_names[static_cast<std::size_t>(a)], grid.coordinate(point, a));
  return fmt::format("{} (j = {})", text, grid.first_unknown() + point + 1);
}

Vector initial_from_formulas(const std::map<std::string, std::string>& formulas, const FormulaConstants& constants,
                             const Problem& problem) {
  const Index dimension = problem.grid.dimension();
  const std::vector<std::string> variables = place_variables(dimension);
  std::vector<double> arguments(variables.size(), 0.0);
  Vector z(problem.size());
  const Index points = problem.grid.unknowns(), first = problem.grid.first_unknown();
  Index at = 0;
  for (const std::string& field : problem.fields) {
    const auto text = formulas.find(field);
    if (text == formulas.end()) throw Error("problem.initial has no formula for the field {}", field);
    FormulaPointer formula;
    try {
      formula = compile_formula(text->second, variables, constants);
    } catch (const Error& error) {
      throw Error("problem.initial.{}: {}", field, error.what());
    }
    for (Index i = 0; i < points; ++i) {
      for (Index a = 0; a < dimension; ++a) arguments[static_cast<std::size_t>(a)] = problem.grid.coordinate(i, a);
      arguments[static_cast<std::size_t>(dimension)] = static_cast<double>(first + i + 1);
      z[at] = (*formula)(arguments);
      if (!std::isfinite(z[at]))
        throw Error("problem.initial: {} = {} is {}{}", field, shortened(text->second), number_text(z[at]),
                    place_text(problem.grid, i));
      ++at;
    }
  }
  return z;
}

void require_finite_force(const Problem& problem) {
  if (!problem.potential) return;
  const Index n = problem.grid.unknowns();
  const Index begin = problem.potential_field * n;
  std::vector<double> u(problem.initial.begin() + begin,
                        problem.initial.begin() + begin + problem.potential->fields() * n);
  std::vector<double> force(u.size());
  // Of the whole grid a part has no projection: there V itself is looked at.
  const auto* truncated = dynamic_cast<const TruncatedPotential*>(problem.potential.get());
  const bool is_part = problem.grid.here.count > 1 && truncated != nullptr;
  (is_part ? *truncated->whole() : *problem.potential).value_and_gradient(u, force);
  for (std::size_t i = 0; i < force.size(); ++i) {
    if (std::isfinite(force[i])) continue;
    const auto point = static_cast<Index>(i) % n;
    std::string values;
    for (Index f = 0; f < problem.field_count(); ++f)
      values += fmt::format("{}{} = {}", f > 0 ? ", " : "", problem.fields[static_cast<std::size_t>(f)],
                            problem.initial[f * n + point]);
    throw Error("the force of V on {} is {} at the initial state{}, where {}",
                problem.fields[static_cast<std::size_t>(problem.potential_field + static_cast<Index>(i) / n)],
                number_text(force[i]), place_text(problem.grid, point), values);
  }
}

}  // namespace seiche
