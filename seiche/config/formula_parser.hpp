// The grammar of formulas: + - * / ^ with the usual precedence (^ binds to the right and before the sign), functions,
// pi, and the given variables. Whatever is refused is refused here, with its column.
#pragma once

#include <seiche/config/formula_program.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace seiche {

inline constexpr int highest_degree = 64;
inline constexpr int deepest_nesting = 60;

struct ParsedFormula {
  FormulaProgram program;  // constants folded
  int degree = 0;          // a bound on the degree in all variables together; −1 if not a polynomial as written
};

ParsedFormula parse_formula(std::string_view text, const std::vector<std::string>& variables);

}  // namespace seiche
