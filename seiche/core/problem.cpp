#include <seiche/core/error.hpp>
#include <seiche/core/problem.hpp>

namespace seiche {
namespace {

bool any_entry_in_row(const BlockStencil& a, Index row) {
  for (Index j = 0; j < a.fields(); ++j)
    if (!a(row, j).is_zero()) return true;
  return false;
}

// ∇_vH = v for field v: M acts on it as the identity, alone, and V does not depend on it.
bool gradient_is_identity(const Problem& p, Index field) {
  if (field == p.potential_field && p.potential) return false;
  for (Index j = 0; j < p.field_count(); ++j) {
    if (j == field ? !p.M(field, j).is_identity() : !p.M(field, j).is_zero()) return false;
  }
  return true;
}

}  // namespace

bool LinearDamping::moves(Index field) const {
  return any_entry_in_row(constant, field) || (rate && rate_fields[static_cast<std::size_t>(field)]);
}

Problem with_damping_merged(const Problem& problem) {
  const LinearDamping& damping = problem.damping;
  if (damping.is_zero()) return problem;
  if (damping.rate && !damping.rate->is_constant()) {
    throw Error(
        "a method that merges the damping into S needs a constant D, but the rate {} varies with time; "
        "the splitting methods (savf, ssav, slm, seavf, seisav, seilm, seidm) take it",
        damping.rate->text());
  }
  Problem merged = problem;
  const auto merge = [&](Index row, Index column, const Stencil& d) {
    if (d.is_zero()) return;
    if (!gradient_is_identity(problem, column)) {
      throw Error(
          "a method that merges the damping into S needs Dz = D'∇H(z), but in {} the damped field {} has "
          "∇H ≠ {}; the splitting methods (savf, ssav, slm, seavf, seisav, seilm, seidm) take it",
          problem.name, problem.fields[static_cast<std::size_t>(column)],
          problem.fields[static_cast<std::size_t>(column)]);
    }
    merged.S(row, column) += -1.0 * d;
  };
  for (Index i = 0; i < problem.field_count(); ++i) {
    for (Index j = 0; j < problem.field_count(); ++j) merge(i, j, damping.constant(i, j));
    if (damping.rate && damping.rate_fields[static_cast<std::size_t>(i)]) {
      merge(i, i, Stencil::identity(damping.rate->value(0)));
    }
  }
  merged.damping = LinearDamping{.constant = BlockStencil(problem.field_count()), .rate = nullptr, .rate_fields = {}};
  return merged;
}

}  // namespace seiche
