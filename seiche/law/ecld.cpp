#include <seiche/law/ecld.hpp>

#include <optional>
#include <utility>

namespace seiche {

namespace {

// c with cI in the rows of a field, or nothing.
std::optional<double> multiple_of_identity(const SparseMatrix& D, Index first, Index count) {
  Vector diagonal = Vector::Zero(count);
  bool is_diagonal = true;
  for_entries(D, [&](Index i, Index j, double value) {
    if (i < first || i >= first + count) return;
    if (i == j)
      diagonal[i - first] += value;
    else
      is_diagonal = is_diagonal && value == 0;
  });
  if (!is_diagonal || (diagonal.array() != diagonal[0]).any()) return std::nullopt;
  return diagonal[0];
}

// Of the fields that V depends on, the first that damping moves, where those before it rest and all from there on are
// damped by one rate for all points, and by nothing else. Counted from the first field of V.
std::optional<Index> shrinks_together_from(const Problem& problem) {
  const LinearDamping& damping = problem.damping;
  if (damping.field_rate) return std::nullopt;
  std::optional<std::pair<bool, double>> first;  // by γ(t), and by so much beside it
  Index resting = 0;
  for (Index field = 0; field < problem.field_count(); ++field) {
    if (!problem.potential_depends_on(field)) continue;
    if (!first && !problem.damping_moves(field)) {
      ++resting;
      continue;
    }
    if (problem.friction && field >= problem.field_count() / 2) return std::nullopt;
    double constant = 0;
    if (problem.matrices) {
      const Index points = problem.grid.unknowns();
      const std::optional<double> factor = multiple_of_identity(problem.matrices->D, field * points, points);
      if (!factor || *factor < 0) return std::nullopt;
      constant = *factor;
    }
    for (Index j = 0; j < problem.field_count() && !problem.matrices; ++j) {
      const Stencil& entry = damping.constant(field, j);
      const std::optional<double> factor = entry.factor_of_identity();
      if (!factor || (j != field && *factor != 0) || *factor < 0) return std::nullopt;
      if (j == field) constant = *factor;
    }
    const bool by_rate = damping.rate && damping.rate_fields[static_cast<std::size_t>(field)];
    if (first && *first != std::pair(by_rate, constant)) return std::nullopt;
    first = {by_rate, constant};
  }
  return resting;
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
  const std::optional<Index> from = shrinks_together_from(problem);
  if (from && problem.potential->grows_outward_from(*from))
    return {true, *from == 0 ? "D = γI where V depends on u, and u·∇V(u) ≥ 0 for every u"
                             : "D = γI on the damped fields v of V(u, v), and v·∂V/∂v ≥ 0 for all u and v"};
  return {
      false,
      "the damping moves the field that V depends on, and the form of V does not show that it falls when that shrinks: "
      "the energy-compatible damping condition is not guaranteed"};
}

}  // namespace seiche
