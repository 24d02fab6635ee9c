#include <seiche/core/commuting_damping.hpp>

namespace seiche {

bool rate_commutes(const Problem& problem) {
  const LinearDamping& damping = problem.damping;
  if (!damping.rate) return true;
  const auto is_marked = [&](Index field) { return damping.rate_fields[static_cast<std::size_t>(field)]; };
  bool commutes = true;
  if (problem.matrices) {
    const Index n = problem.grid.unknowns();
    for_entries(problem.matrices->D, [&](Index row, Index column, double value) {
      if (value != 0 && is_marked(row / n) != is_marked(column / n)) commutes = false;
    });
    return commutes;
  }
  for (Index i = 0; i < problem.field_count(); ++i)
    for (Index j = 0; j < problem.field_count(); ++j)
      if (!damping.constant(i, j).is_zero() && is_marked(i) != is_marked(j)) commutes = false;
  return commutes;
}

bool has_constant_rates(const LinearDamping& damping) {
  return (!damping.rate || damping.rate->is_constant()) && (!damping.field_rate || damping.field_rate->is_constant());
}

}  // namespace seiche
