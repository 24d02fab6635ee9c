// The names in formulas of friction: v and u, a velocity and its coordinate, or what the fields of the problem are
// called.
#pragma once

#include <seiche/formula/formula_parser.hpp>

#include <string>
#include <vector>

namespace seiche {

// v, u, t, x, y, z, in the order of FrictionFormula's arguments; without places x, y and z are "", which no formula can
// name.
std::vector<std::string> friction_variables(bool has_place = true);

// Throws Error with the place in the formula for a name that means nothing, and for v or u where a field of that name
// is not the velocity, or not the coordinate. Where there is one pair of fields (q, p) these may be named too; of
// several pairs, a formula serves each.
void check_friction_names(const std::string& text, const std::vector<std::string>& fields,
                          const FormulaConstants& constants, bool has_place, const NameAdvice& advice);

// The same formula in v and u: q̇ = v = wp with w = `inverse_mass`.
std::string in_velocity_and_coordinate(const std::string& text, const std::vector<std::string>& fields,
                                       double inverse_mass);

}  // namespace seiche
