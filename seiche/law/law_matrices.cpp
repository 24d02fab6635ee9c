#include <seiche/core/error.hpp>
#include <seiche/law/ecld.hpp>
#include <seiche/law/law_matrices.hpp>

namespace seiche {
namespace {

bool in_rate_field(const Problem& problem, Index row) {
  return problem.damping.rate_fields[static_cast<std::size_t>(row / problem.grid.unknowns())];
}

// M diagonal in the rows of the fields that γ(x, t) damps: then sym(MD) ⪰ 0 whatever γ ≥ 0.
bool metric_is_diagonal_where_damped(const Problem& problem) {
  bool diagonal = true;
  for_entries(problem.matrices->M, [&](Index i, Index j, double value) {
    diagonal = diagonal && (i == j || value == 0 || !in_rate_field(problem, i));
  });
  return diagonal;
}

std::string complaint_about_rates(const Problem& problem, double t_end) {
  const LinearDamping& damping = problem.damping;
  if (std::string text = complaint_about_rate(damping.rate.get(), t_end); !text.empty()) return text;
  if (std::string text = complaint_about_rate(damping.field_rate.get(), t_end); !text.empty()) return text;
  if (damping.field_rate && !metric_is_diagonal_where_damped(problem))
    return fmt::format("the rate {} changes from point to point and M is not diagonal where it damps",
                       damping.field_rate->text());
  return "";
}

}  // namespace

LawPromise promise_energy_law_of_matrices(const Problem& problem, double t_end, const OperatorFindings& findings) {
  const LinearDamping& damping = problem.damping;
  if (const auto& x = findings.M.negative_direction)
    return {false, fmt::format("M is not positive semidefinite (zᵀMz = {:.3g} for a z of norm 1)", x->value)};
  if (const auto& x = findings.minus_S.negative_direction)
    return {false, fmt::format("sym(S) is not negative semidefinite (zᵀSz = {:.3g} for a z of norm 1)", -x->value)};
  if (!problem.has_damping()) return {true, "sym(S) ⪯ 0 and no damping flow"};

  if (std::string text = complaint_about_rates(problem, t_end); !text.empty()) return {false, text};
  const bool feeds = (findings.MD_constant && !findings.MD_constant->holds()) ||
                     (damping.rate && findings.MD_rate && !findings.MD_rate->holds());
  if (feeds) return {false, "sym(MD) is not positive semidefinite: the damping feeds some direction"};
  return promise_given_semidefinite_MD(problem);
}

}  // namespace seiche
