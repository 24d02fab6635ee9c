// Coefficients that are written as formulas: rates of damping, of time alone or of time and place, and functions of a
// field.
#pragma once

#include <seiche/core/damping_rate.hpp>
#include <seiche/core/structure.hpp>
#include <seiche/core/text/name_advice.hpp>
#include <seiche/formula/formula_compiler.hpp>

#include <string>
#include <vector>

namespace seiche {

// Null where the text is no formula in these variables.
FormulaPointer compiled_or_null(const std::string& text, const std::vector<std::string>& variables,
                                const FormulaConstants& constants);

// A formula in t and as many of x, y, z as it names, which asks the grid for so many axes. Throws Error that names the
// key.
SpaceRatePointer compile_space_rate(const std::string& key, const std::string& text,
                                    const FormulaConstants& constants = {}, const NameAdvice& advice = {});
// The same, and where it names t alone a rate for all points.
DampingRate compile_damping_rate(const std::string& key, const std::string& text,
                                 const FormulaConstants& constants = {});

// Of a field, by its name.
StateFunctionPointer compile_state_function(const std::string& text, const std::string& field,
                                            const FormulaConstants& constants = {});

}  // namespace seiche
