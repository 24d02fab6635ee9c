// The functions that a formula may name.
#pragma once

#include <seiche/core/simd/vector_functions.hpp>

#include <cstddef>
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
  // Of y = f(x): by how much it may be off where x is by `off`, all in units of ε. Arity 1.
  double (*carried)(double x, double y, double off);
  bool differentiable = true;  // but for kinks, as that of abs at 0
  // The same of many points, to 1 ulp; null: one after the other.
  VectorFunctions::One VectorFunctions::*of_many = nullptr;
  void (*mean_slopes)(const double* a, const double* b, double* slopes, std::size_t n) = nullptr;
};

std::span<const FormulaFunction> formula_functions();
const FormulaFunction* find_formula_function(std::string_view name);  // null: no such function

// The same for xⁿ with whole n, and for xᶜ.
double mean_slope_of_whole_power(double a, double b, int n);
double mean_slope_of_power(double a, double b, double c);  // a, b ≥ 0

}  // namespace seiche
