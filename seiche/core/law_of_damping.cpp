#include <seiche/core/law_of_damping.hpp>

#include <optional>
#include <utility>

namespace seiche {

namespace {

// Are all fields that V depends on damped by one rate for all of them and all points, and by nothing else?
bool shrinks_together(const Problem& problem) {
  const LinearDamping& damping = problem.damping;
  if (damping.field_rate || (problem.matrices && problem.has_constant_damping())) return false;
  std::optional<std::pair<bool, double>> first;  // by γ(t), and by so much beside it
  for (Index field = 0; field < problem.field_count(); ++field) {
    if (!problem.potential_depends_on(field)) continue;
    if (problem.friction && field >= problem.field_count() / 2) return false;
    double constant = 0;
    for (Index j = 0; j < problem.field_count() && !problem.matrices; ++j) {
      const Stencil& entry = damping.constant(field, j);
      const std::optional<double> factor = entry.factor_of_identity();
      if (!factor || (j != field && *factor != 0) || *factor < 0) return false;
      if (j == field) constant = *factor;
    }
    const bool by_rate = damping.rate && damping.rate_fields[static_cast<std::size_t>(field)];
    if (first && *first != std::pair(by_rate, constant)) return false;
    first = {by_rate, constant};
  }
  return true;
}

}  // namespace

std::string complaint_beyond_linear(const Problem& problem, double t_end) {
  std::string driven = problem.has_forces() ? "an external force does work on the system" : "";
  if (!problem.friction || problem.friction->is_dissipative()) return driven;
  const std::string place = problem.friction->feeds_at(t_end);
  if (place.empty()) return driven;
  return fmt::format("{}the friction {} feeds energy at {}", driven.empty() ? "" : driven + ", and ",
                     problem.friction->text(), place);
}

LawPromise promise_given_semidefinite_MD(const Problem& problem) {
  if (!problem.damping_moves_potential()) return {true, "sym(MD) ⪰ 0 and V does not depend on the damped fields"};
  // sym(MD) ⪰ 0 is not enough where damping moves what V depends on. D = γ there lets V fall where u·∇V(u) ≥ 0.
  if (shrinks_together(problem) && problem.potential->grows_outward())
    return {true, "D = γI where V depends on u, and u·∇V(u) ≥ 0 for every u"};
  return {
      false,
      "the damping moves the field that V depends on, and the form of V does not show that it falls when that shrinks: "
      "the energy-compatible damping condition is not guaranteed"};
}

}  // namespace seiche
