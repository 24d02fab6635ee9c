#include <seiche/core/law_of_damping.hpp>

#include <algorithm>

namespace seiche {

std::string complaint_beyond_linear(const Problem& problem, double t_end) {
  if (problem.has_forces()) return "an external force does work on the system";
  if (!problem.friction || problem.friction->is_dissipative()) return "";
  const std::string place = problem.friction->feeds_at(t_end);
  return place.empty() ? "" : fmt::format("the friction {} feeds energy at {}", problem.friction->text(), place);
}

LawPromise promise_given_semidefinite_MD(const Problem& problem) {
  if (!problem.damping_moves_potential()) return {true, "sym(MD) ⪰ 0 and V does not depend on the damped fields"};
  // sym(MD) ⪰ 0 is not enough where damping moves what V depends on. D = γI lets V fall where u·∇V(u) ≥ 0.
  const LinearDamping& damping = problem.damping;
  const bool scalar = !problem.has_constant_damping() && !damping.field_rate &&
                      std::all_of(damping.rate_fields.begin(), damping.rate_fields.end(), [](bool b) { return b; });
  if (scalar && problem.potential->grows_outward()) return {true, "D = γI and u·∇V(u) ≥ 0 for every u"};
  return {false,
          "the damping moves the field that V depends on, and V can rise when it shrinks: the "
          "energy-compatible damping condition is not guaranteed"};
}

}  // namespace seiche
