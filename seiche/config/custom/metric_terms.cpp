#include <seiche/config/custom/metric_terms.hpp>
#include <seiche/core/base/error.hpp>

namespace seiche {
namespace {

using Factor = QuadraticTerm::Factor;

// ∂ᵃu·∂ᵇv as u·(−1)ᵃ∂ᵃ⁺ᵇv
Stencil product(const Factor& a, const Factor& b, const Grid& grid, Discretisation discretisation) {
  using Kind = Factor::Kind;
  if (a.kind == Kind::bond || b.kind == Kind::bond) {
    if (a.kind != b.kind) throw Error("a difference between neighbours stands beside what belongs to a point");
    return -square(grid.axis(0).dx()) * Stencil::second_derivative(grid, 0, Discretisation::fd2);
  }
  if (a.kind != Kind::value && b.kind != Kind::value && a.axis != b.axis)
    throw Error("products of derivatives along different axes are not there");
  const Index axis = a.kind != Kind::value ? a.axis : b.axis;
  const int order = static_cast<int>(a.kind) + static_cast<int>(b.kind);  // value, first, second
  const double sign = a.kind == Kind::first ? -1 : 1;
  switch (order) {
    case 0: return Stencil::identity();
    case 1: return sign * Stencil::derivative(grid, axis, discretisation);
    case 2: return sign * Stencil::second_derivative(grid, axis, discretisation);
    case 3: return sign * Stencil::third_derivative(grid, axis, discretisation);
    default: return Stencil::fourth_derivative(grid, axis, discretisation);
  }
}

}  // namespace

// Once for each of the two rows.
void add_quadratic(const QuadraticTerm& term, const Grid& grid, Discretisation discretisation, BlockStencil& M) {
  M(term.a.field, term.b.field) += term.coefficient * product(term.a, term.b, grid, discretisation);
  M(term.b.field, term.a.field) += term.coefficient * product(term.b, term.a, grid, discretisation);
}

}  // namespace seiche
