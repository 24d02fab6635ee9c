// Initial data by formulas in the place, and whether V lets a run begin there.
#pragma once

#include <seiche/core/problem.hpp>
#include <seiche/formula/formula_parser.hpp>

#include <map>
#include <string>
#include <vector>

namespace seiche {

// x, y, z as far as the grid has them, and j = 1, 2, …, the number of the point.
std::vector<std::string> place_variables(Index axes);

// Values of all fields, in the order of z. Throws Error where a field has no formula, or a value is not finite.
Vector initial_from_formulas(const std::map<std::string, std::string>& formulas, const FormulaConstants& constants,
                             const Problem& problem);

// " at x = 0.1, y = 0.3 (j = 4)"; where points lie nowhere " at j = 4", and nothing for the only one of a few degrees
// of freedom.
std::string place_text(const Grid& grid, Index point);

// Throws Error with the field, the point and the values there where the force of V is not finite at the initial state,
// as that of 1/q is at q = 0.
void require_finite_force(const Problem& problem);

}  // namespace seiche
