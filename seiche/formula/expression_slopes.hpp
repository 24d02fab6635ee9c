// What a graph of operations tells beside its values: mean slopes, bounds of round-off, and Taylor coefficients of
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

// The same sums of products without their signs, where a = b: by some ε of that mean slopes may be off, where their
// terms cancel. `bounds`: as error_bounds gives them, of the values.
void sizes_of_slopes(const ExpressionGraph& graph, const double* at, const double* bounds, int directions,
                     std::size_t points, double* sizes);

// By how much the values of a table as after evaluate may be off, in units of ε: a running error bound, in which the
// variables are off by ε of themselves, numbers by nothing, and every operation adds ε of its result to what it carries
// on (Wilkinson 1963; Higham 2002, section 3.3). Of the nodes before `end`. Where that is not finite, as beside an
// infinite value, |value|.
void error_bounds(const ExpressionGraph& graph, const double* table, std::size_t points, std::size_t end,
                  double* bounds);

// Coefficients of x ↦ f(p + xq) for the first program, a polynomial in the variables where q ≠ 0 of at most `degree`,
// added to `coefficients`.
inline std::size_t taylor_scratch_size(const ExpressionGraph& graph, int degree) {
  return (graph.nodes().size() + 1) * static_cast<std::size_t>(degree + 1);
}
void add_taylor(const ExpressionGraph& graph, std::span<const double> p, std::span<const double> q, int degree,
                double* scratch, std::span<double> coefficients);

}  // namespace seiche
