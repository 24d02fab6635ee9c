// S, M and D of a problem written down: tables of formulas, one row and one column for each field.
#pragma once

#include <seiche/core/problem.hpp>
#include <seiche/formula/formula_parser.hpp>

#include <string>
#include <vector>

namespace seiche {

using FormulaTable = std::vector<std::vector<std::string>>;  // row by row

class CustomTables {
 public:
  // Grid and fields are those of the problem, which must outlive this. `axes`: 0 where there is no place.
  CustomTables(const Problem& problem, Index axes, Discretisation discretisation, const FormulaConstants& constants)
      : problem_(problem), axes_(axes), discretisation_(discretisation), constants_(constants) {}

  // Of S or M, which are constant. Throws Error with the key and the place in the formula.
  BlockStencil block(const char* name, const FormulaTable& entries) const;

  // Of D. A rate on the diagonal acts exactly on its fields, and apart from derivatives. Throws Error also for rates
  // off the diagonal, and for two that differ.
  LinearDamping damping(const FormulaTable& entries) const;
  void require_finite_rates(const LinearDamping& damping) const;  // at t = 0; throws Error with the point

  std::string entry_key(const char* name, Index row, Index column) const;

 private:
  Index fields() const { return problem_.field_count(); }
  void require_shape(const char* name, const FormulaTable& entries) const;
  template <class Take>
  void for_entries(const char* name, const FormulaTable& entries, bool may_vary, const Take& take) const;
  void take_constant_rate(LinearDamping& damping) const;

  const Problem& problem_;
  Index axes_;
  Discretisation discretisation_;
  const FormulaConstants& constants_;
};

}  // namespace seiche
