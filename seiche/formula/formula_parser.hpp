// The grammar of formulas: + - * / ^ with the usual precedence (^ binds to the right and before the sign), functions,
// pi, the given variables, and names of numbers. Whatever is refused is refused here, with its column.
#pragma once

#include <seiche/core/text/name_advice.hpp>
#include <seiche/formula/formula_program.hpp>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace seiche {

inline constexpr int highest_degree = 64;
inline constexpr int deepest_nesting = 60;
inline constexpr int highest_tower = 4;  // of powers in exponents

struct ParsedFormula {
  FormulaProgram program;  // constants folded
  int degree = 0;          // a bound on the degree in all variables together; −1 if not a polynomial as written
};

using FormulaConstants = std::map<std::string, double>;

// Beside dx among the constants, this lets formulas on a line name j = x/dx + the number: that of a point, 1, 2, ….
inline constexpr const char* index_before_line = "j at x = 0";

enum class FunctionsAllowed { all, differentiable };  // of what varies: of numbers alone, min(eps, 1) is a number

// `advice` is asked about all other names.
ParsedFormula parse_formula(std::string_view text, const std::vector<std::string>& variables,
                            const FormulaConstants& constants = {}, const NameAdvice& advice = {},
                            FunctionsAllowed allowed = FunctionsAllowed::all);

}  // namespace seiche
