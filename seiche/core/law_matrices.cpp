#include <seiche/core/definiteness.hpp>
#include <seiche/core/error.hpp>
#include <seiche/core/law_matrices.hpp>

#include <algorithm>

namespace seiche {
namespace {

bool in_rate_field(const Problem& problem, Index row) {
  return problem.damping.rate_fields[static_cast<std::size_t>(row / problem.grid.unknowns())];
}

// γ(t) P.
SparseMatrix rate_projection(const Problem& problem) {
  SparseMatrix p(problem.size(), problem.size());
  for (Index i = 0; i < problem.size(); ++i)
    if (in_rate_field(problem, i)) p.insert(i, i) = 1;
  return p;
}

// M diagonal in the rows of the fields that γ(x, t) damps: then sym(MD) ⪰ 0 whatever γ ≥ 0.
bool metric_is_diagonal_where_damped(const Problem& problem) {
  const SparseMatrix& M = problem.matrices->M;
  for (Index column = 0; column < M.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(M, column); entry; ++entry)
      if (entry.row() != column && entry.value() != 0 && in_rate_field(problem, entry.row())) return false;
  return true;
}

std::string complaint_about_rates(const Problem& problem, double t_end) {
  const LinearDamping& damping = problem.damping;
  const auto negative = [t_end](const auto& rate) -> std::string {
    const double t = rate ? rate->first_negative_time(t_end) : -1.0;
    return t >= 0 ? fmt::format("the rate {} is negative at t = {:.6g}", rate->text(), t) : "";
  };
  if (std::string text = negative(damping.rate); !text.empty()) return text;
  if (std::string text = negative(damping.field_rate); !text.empty()) return text;
  if (damping.field_rate && !metric_is_diagonal_where_damped(problem))
    return fmt::format("the rate {} changes from point to point and M is not diagonal where it damps",
                       damping.field_rate->text());
  return "";
}

}  // namespace

LawPromise promise_energy_law_of_matrices(const Problem& problem, double t_end) {
  const SparseOperators& matrices = *problem.matrices;
  const LinearDamping& damping = problem.damping;
  if (const auto x = negative_direction(matrices.M))
    return {false, fmt::format("M is not positive semidefinite (zᵀMz = {:.3g} for a z of norm 1)", x->value)};
  if (const auto x = negative_direction(SparseMatrix(-symmetric_part(matrices.S))))
    return {false, fmt::format("sym(S) is not negative semidefinite (zᵀSz = {:.3g} for a z of norm 1)", -x->value)};
  if (!problem.has_damping()) return {true, "sym(S) ⪯ 0 and no damping flow"};

  if (std::string text = complaint_about_rates(problem, t_end); !text.empty()) return {false, text};
  const bool feeds = negative_direction(symmetric_part(matrices.M * matrices.D)) ||
                     (damping.rate && negative_direction(symmetric_part(matrices.M * rate_projection(problem))));
  if (feeds) return {false, "sym(MD) is not positive semidefinite: the damping feeds some direction"};
  if (!problem.damping_moves_potential()) return {true, "sym(MD) ⪰ 0 and V does not depend on the damped fields"};

  const bool scalar = matrices.D.nonZeros() == 0 && !damping.field_rate &&
                      std::all_of(damping.rate_fields.begin(), damping.rate_fields.end(), [](bool b) { return b; });
  if (scalar && problem.potential->grows_outward()) return {true, "D = γI and u·∇V(u) ≥ 0 for every u"};
  return {false,
          "the damping moves the field that V depends on, and V can rise when it shrinks: the "
          "energy-compatible damping condition is not guaranteed"};
}

}  // namespace seiche
