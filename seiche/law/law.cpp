#include <seiche/core/base/error.hpp>
#include <seiche/core/text/axis_names.hpp>
#include <seiche/law/ecld.hpp>
#include <seiche/law/law.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace seiche {
namespace {

// "t = 1, x = 0.5, y = 2" where the rate is smallest at time t.
std::string place_of_smallest(const FieldRate& rate, const Grid& grid, double t) {
  std::vector<double> gamma(static_cast<std::size_t>(grid.unknowns()));
  rate.values(t, gamma);
  const auto point = std::min_element(gamma.begin(), gamma.end()) - gamma.begin();
  std::string text = fmt::format("t = {:.6g}", t);
  for (Index a = 0; a < grid.dimension(); ++a)
    text += fmt::format(", {} = {:.6g}", axis_names[static_cast<std::size_t>(a)], grid.coordinate(point, a));
  return text;
}

// What stands against sym(MD) ⪰ 0 for D = γ(x, t)P, or "". The symbol of γ(x, t) has no modes: the sign of MD is known
// where M is a multiple of the identity on the damped fields, and there only.
std::string complaint_about_field_rate(const Problem& problem, double t_end) {
  const FieldRate& rate = *problem.damping.field_rate;
  const double t_bad = rate.first_negative_time(t_end);
  if (t_bad >= 0)
    return fmt::format("the rate {} is negative at {}", rate.text(), place_of_smallest(rate, problem.grid, t_bad));
  for (Index i = 0; i < problem.field_count(); ++i) {
    if (!problem.damping.rate_fields[static_cast<std::size_t>(i)]) continue;
    for (Index j = 0; j < problem.field_count(); ++j) {
      if (i == j ? problem.M(i, i).factor_of_identity().has_value() : problem.M(i, j).is_zero()) continue;
      return fmt::format(
          "the rate {} changes from point to point and M is not a multiple of the identity on the damped field {}: "
          "sym(MD) ⪰ 0 is not guaranteed",
          rate.text(), problem.fields[static_cast<std::size_t>(i)]);
    }
  }
  if (problem.damping_moves_potential()) return "the rate changes from point to point and moves what V depends on";
  return "";
}

LawPromise promise_of_stencils(const Problem& problem, double t_end, const OperatorFindings& findings) {
  if (!findings.M.holds())
    return {false, fmt::format("M is not positive semidefinite (eigenvalue {:.3g})", findings.M.over_modes->value)};
  if (!findings.minus_S.holds())
    return {false, fmt::format("sym(S) is not negative semidefinite (eigenvalue {:.3g})",
                               -findings.minus_S.over_modes->value)};
  const LinearDamping& damping = problem.damping;
  if (!problem.has_damping()) return {true, "sym(S) ⪯ 0 and no damping flow"};

  if (const std::string complaint = complaint_about_rate(damping.rate.get(), t_end); !complaint.empty())
    return {false, complaint};
  if (damping.field_rate) {
    const std::string complaint = complaint_about_field_rate(problem, t_end);
    if (!complaint.empty()) return {false, complaint};
  }
  const bool feeds = (findings.MD_constant && !findings.MD_constant->holds()) ||
                     (damping.rate && findings.MD_rate && !findings.MD_rate->holds());
  if (feeds) return {false, "sym(MD) is not positive semidefinite: the damping feeds some mode"};
  return promise_given_semidefinite_MD(problem);
}

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

// What stands against sym(MD) ⪰ 0 for the rates of a problem stated by matrices, or "".
std::string complaint_about_rates(const Problem& problem, double t_end) {
  const LinearDamping& damping = problem.damping;
  if (std::string text = complaint_about_rate(damping.rate.get(), t_end); !text.empty()) return text;
  if (std::string text = complaint_about_rate(damping.field_rate.get(), t_end); !text.empty()) return text;
  if (damping.field_rate && !metric_is_diagonal_where_damped(problem))
    return fmt::format("the rate {} changes from point to point and M is not diagonal where it damps",
                       damping.field_rate->text());
  return "";
}

// M ⪰ 0, sym(S) ⪯ 0 and sym(MD) ⪰ 0 by factorisation.
LawPromise promise_of_matrices(const Problem& problem, double t_end, const OperatorFindings& findings) {
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

// Is there any damping but a rate that is written down as 0?
bool is_damped(const Problem& problem) {
  const LinearDamping& damping = problem.damping;
  const bool rests = !damping.rate || (damping.rate->is_constant() && damping.rate->value(0) == 0);
  return !rests || damping.field_rate || problem.friction || problem.has_constant_damping();
}

// What stands against a law whatever S, M and D are; beside it a negative rate, which a reader would look for next.
std::string complaints_beyond_linear(const Problem& problem, double t_end) {
  std::string all = complaint_beyond_linear(problem, t_end);
  if (all.empty()) return "";
  const LinearDamping& damping = problem.damping;
  for (const std::string& rate :
       {complaint_about_rate(damping.rate.get(), t_end), complaint_about_rate(damping.field_rate.get(), t_end)})
    if (!rate.empty()) all += ", and " + rate;
  return all;
}

// A short part of a span in which a rate is infinite. `exists`: of its integral over a span; where it does so on all
// parts of one, that was merely too long for the quadrature.
template <class Exists>
std::optional<TimeSpan> around_pole(const Exists& exists, TimeSpan span) {
  constexpr int halvings = 10;
  if (exists(span)) return std::nullopt;
  for (int i = 0; i < halvings; ++i) {
    span.length /= 2;
    if (!exists(span)) continue;
    span.begin += span.length;
    if (exists(span)) return std::nullopt;
  }
  return span;
}

}  // namespace

void require_finite_rates(const Problem& problem, double t_start, double t_end) {
  const auto require = [&](const char* what, const auto& rate, const auto& exists, const auto& is_number) {
    if (!rate || rate->is_constant() || !(t_end > t_start)) return;
    const std::optional<TimeSpan> pole = around_pole(exists, {t_start, t_end - t_start});
    if (!pole) return;
    const double end = pole->begin + pole->length;
    throw Error("the {} {} {} between t = {:.6g} and {:.6g}, and no solution goes on from there; end the run before",
                what, rate->text(), is_number(end) ? "is infinite" : "ceases to be a real number", pole->begin, end);
  };
  const LinearDamping& damping = problem.damping;
  require(
      "rate", damping.rate,
      [&](const TimeSpan& span) { return std::isfinite(damping.rate->integral(span.begin, span.length)); },
      [&](double t) { return !std::isnan(damping.rate->value(t)); });
  std::vector<double> values(static_cast<std::size_t>(problem.grid.unknowns()));
  const auto are_finite = [&] {
    return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  };
  const auto integrable = [&](const FieldRate& rate) {
    return [&](const TimeSpan& span) {
      rate.integrals(span.begin, span.length, values);
      return are_finite();
    };
  };
  const auto are_numbers = [&](const FieldRate& rate) {
    return [&](double t) {
      rate.values(t, values);
      return std::none_of(values.begin(), values.end(), [](double value) { return std::isnan(value); });
    };
  };
  if (damping.field_rate)
    require("rate", damping.field_rate, integrable(*damping.field_rate), are_numbers(*damping.field_rate));
  for (std::size_t f = 0; f < problem.forces.size(); ++f) {
    const FieldRatePointer& force = problem.forces[f];
    if (!force) continue;
    force->values(t_start, values);
    if (!are_finite())
      throw Error("the force {} on the field {} is no finite number at t = {:.6g}", force->text(), problem.fields[f],
                  t_start);
    require("force", force, integrable(*force), are_numbers(*force));
  }
}

LawPromise promise_energy_law(const Problem& problem, double t_end) {
  return promise_energy_law(problem, t_end, look_at_operators(problem));
}

LawPromise promise_energy_law(const Problem& problem, double t_end, const OperatorFindings& findings) {
  if (const std::string complaint = complaints_beyond_linear(problem, t_end); !complaint.empty())
    return {false, complaint};
  LawPromise promise =
      problem.matrices ? promise_of_matrices(problem, t_end, findings) : promise_of_stencils(problem, t_end, findings);
  promise.never_grows = promise.promised;
  promise.never_changes = findings.S_is_skew && !is_damped(problem);
  return promise;
}

std::string negative_rate(const Problem& problem) {
  const auto complaint = [](const auto& rate) -> std::string {
    if (!rate || rate->negative_seen() < 0) return "";
    return fmt::format("the rate {} is negative at t = {:.6g}", rate->text(), rate->negative_seen());
  };
  std::string fed = problem.friction ? problem.friction->complaint() : "";
  if (!fed.empty()) return fed;
  const std::string everywhere = complaint(problem.damping.rate);
  return everywhere.empty() ? complaint(problem.damping.field_rate) : everywhere;
}

}  // namespace seiche
