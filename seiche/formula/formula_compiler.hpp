// From the text of a formula to a Formula, and from a Formula to its derivative. Computer algebra (GiNaC) works only
// while compiling; what comes out is a plain program.
#pragma once

#include <seiche/formula/formula.hpp>
#include <seiche/formula/formula_parser.hpp>

#include <string>
#include <vector>

namespace seiche {

// Throws Error that points into the text. Arguments of the formula come in the order of `variables`; `constants` become
// numbers.
FormulaPointer compile_formula(const std::string& text, const std::vector<std::string>& variables,
                               const FormulaConstants& constants = {}, const NameAdvice& advice = {});

// What computer algebra has made of formulas in these variables.
FormulaPointer formula_of(std::string text, const std::vector<std::string>& variables, FormulaProgram program);

// ∂f/∂variable. `formula` must come from compile_formula or differentiate; throws Error for min and max, and where the
// variable is not one of the formula's.
FormulaPointer differentiate(const Formula& formula, const std::string& variable);

}  // namespace seiche
