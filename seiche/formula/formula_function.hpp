// The functions that a formula may name.
#pragma once

#include <span>
#include <string_view>

namespace seiche {

struct FormulaFunction {
  std::string_view name;
  int arity;
  double (*one)(double);          // arity 1
  double (*two)(double, double);  // arity 2
  // (f(b) − f(a)) / (b − a), and f'(a) where a = b, without cancellation; NaN where f is not real between them. Arity
  // 1.
  double (*mean_slope)(double a, double b);
  bool differentiable = true;  // but for kinks, as that of abs at 0
};

std::span<const FormulaFunction> formula_functions();
const FormulaFunction* find_formula_function(std::string_view name);  // null where there is none

// The same for xⁿ with whole n, and for xᶜ.
double mean_slope_of_whole_power(double a, double b, int n);
double mean_slope_of_power(double a, double b, double c);  // a, b ≥ 0

}  // namespace seiche
