#include <seiche/config/custom/custom_tables.hpp>
#include <seiche/config/custom/operator_formula.hpp>
#include <seiche/config/data/initial_formulas.hpp>
#include <seiche/config/data/rate_formulas.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/core/text/name_advice.hpp>
#include <seiche/core/text/number_text.hpp>
#include <seiche/damping/rates.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace seiche {

std::string CustomTables::entry_key(const char* name, Index row, Index column) const {
  return fields() == 1 ? fmt::format("problem.{}", name)
                       : fmt::format("problem.{}, row {}, column {}", name, row + 1, column + 1);
}

void CustomTables::require_shape(const char* name, const FormulaTable& entries) const {
  const auto n = static_cast<std::size_t>(fields());
  const bool fits = entries.size() == n &&
                    std::all_of(entries.begin(), entries.end(), [n](const auto& row) { return row.size() == n; });
  if (!fits)
    throw Error("problem.{} must have {} rows of {} entries, one for each of the fields {}", name, n, n,
                fmt::join(problem_.fields, ", "));
}

template <class Take>
void CustomTables::for_entries(const char* name, const FormulaTable& entries, bool may_vary, const Take& take) const {
  require_shape(name, entries);
  using Kind = FormulaContext::Kind;
  const NameAdvice advice =
      advice_in({may_vary ? Kind::damping_entry : Kind::constant_entry, problem_.fields, axes_, true});
  for (Index i = 0; i < fields(); ++i)
    for (Index j = 0; j < fields(); ++j) {
      const std::string& text = entries[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      take(i, j,
           compile_operator(entry_key(name, i, j), text, problem_.grid, axes_, discretisation_, constants_, may_vary,
                            advice));
    }
}

BlockStencil CustomTables::block(const char* name, const FormulaTable& entries) const {
  BlockStencil block(fields());
  for_entries(name, entries, false,
              [&](Index i, Index j, const OperatorFormula& entry) { block(i, j) = entry.stencil; });
  return block;
}

LinearDamping CustomTables::damping(const FormulaTable& entries) const {
  LinearDamping damping{.constant = BlockStencil(fields())};
  damping.rate_fields.assign(static_cast<std::size_t>(fields()), false);
  if (entries.empty()) return damping;
  std::string rate;
  for_entries("D", entries, true, [&](Index i, Index j, const OperatorFormula& entry) {
    damping.constant(i, j) = entry.stencil;
    if (entry.rate.empty()) return;
    if (i != j) throw Error("{} = {}: off the diagonal D is constant", entry_key("D", i, j), shortened(entry.rate));
    if (!rate.empty() && !is_one_rate(rate, entry.rate, constants_))
      throw Error("problem.D has two rates that change, {} and {}; one is possible, of as many fields as wanted",
                  shortened(rate), shortened(entry.rate));
    if (rate.empty()) rate = entry.rate;
    damping.rate_fields[static_cast<std::size_t>(i)] = true;
  });
  if (rate.empty()) {
    take_constant_rate(damping);
  } else {
    const DampingRate changing = compile_damping_rate("problem.D", rate, constants_);
    damping.rate = changing.uniform;
    if (changing.varying) damping.field_rate = changing.varying->on(problem_.grid);
  }
  return damping;
}

void CustomTables::require_finite_rates(const LinearDamping& damping) const {
  if (!damping.rate && !damping.field_rate) return;
  std::vector<double> gamma(static_cast<std::size_t>(problem_.grid.unknowns()));
  if (damping.field_rate) damping.field_rate->values(0, gamma);
  if (damping.rate) gamma.assign(1, damping.rate->value(0));
  for (std::size_t j = 0; j < gamma.size(); ++j)
    if (!std::isfinite(gamma[j]))
      throw Error("problem.D: the rate {} is {} at t = 0{}",
                  shortened(damping.rate ? damping.rate->text() : damping.field_rate->text()), number_text(gamma[j]),
                  damping.rate ? "" : place_text(problem_.grid, static_cast<Index>(j)));
}

// γ on the diagonal of some fields acts exactly on them and apart from derivatives.
void CustomTables::take_constant_rate(LinearDamping& damping) const {
  double rate = 0;
  std::vector<double> diagonal;
  for (Index i = 0; i < fields(); ++i) {
    const double gamma = damping.constant(i, i).identity_part();
    diagonal.push_back(gamma);
    if (gamma == 0) continue;
    if (rate != 0 && gamma != rate) return;
    rate = gamma;
  }
  if (rate == 0) return;
  damping.rate = constant_rate(rate);
  for (Index i = 0; i < fields(); ++i) {
    const double gamma = diagonal[static_cast<std::size_t>(i)];
    damping.constant(i, i) += Stencil::identity(-gamma);
    damping.rate_fields[static_cast<std::size_t>(i)] = gamma != 0;
  }
}

}  // namespace seiche
