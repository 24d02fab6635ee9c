#include <seiche/config/data/finite_force.hpp>
#include <seiche/config/data/initial_formulas.hpp>
#include <seiche/core/error.hpp>
#include <seiche/core/text/number_text.hpp>

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

namespace seiche {

void require_finite_force(const Problem& problem) {
  if (!problem.potential) return;
  const Index n = problem.grid.unknowns();
  const Index begin = problem.potential_field * n;
  std::vector<double> u(problem.initial.begin() + begin,
                        problem.initial.begin() + begin + problem.potential->fields() * n);
  std::vector<double> force(u.size());
  problem.potential->value_and_gradient(u, force);
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
