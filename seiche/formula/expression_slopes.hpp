// What a graph of operations tells beside its values: mean slopes, sizes of terms, and Taylor coefficients of
// polynomials.
#pragma once

#include <seiche/formula/expression_graph.hpp>

#include <cstddef>
#include <span>

namespace seiche {

// At up to `block` points, of the first program: s with Σᵥ sᵥ (bᵥ − aᵥ) = f(b) − f(a), without cancellation. The sum
// and product rules with means in place of values, and mean slopes of functions: ∇f where a = b, symmetric in a and b,
// and therefore the mean gradient to second order; of one variable it is the mean slope. `a` and `b` are tables as
// after evaluate. Slopes are taken in the first `directions` variables; slopes holds directions × block numbers for
// every node.
void mean_slopes(const ExpressionGraph& graph, const double* a, const double* b, int directions, std::size_t points,
                 double* slopes);

// Sizes of the values of a table as after evaluate: |f| with the sizes of the terms of sums.
void term_sizes(const ExpressionGraph& graph, const double* table, std::size_t points, double* sizes);

// Coefficients of x ↦ f(p + xq) for the first program, a polynomial in the variables where q ≠ 0 of at most `degree`,
// added to `coefficients`.
inline std::size_t taylor_scratch_size(const ExpressionGraph& graph, int degree) {
  return (graph.nodes().size() + 1) * static_cast<std::size_t>(degree + 1);
}
void add_taylor(const ExpressionGraph& graph, std::span<const double> p, std::span<const double> q, int degree,
                double* scratch, std::span<double> coefficients);

}  // namespace seiche
