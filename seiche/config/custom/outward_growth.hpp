// Tests whether the form of an energy shows that it falls when its fields shrink together.
#pragma once

#include <seiche/formula/formula_expression.hpp>

namespace seiche {

// u·∇W(u) ≥ 0 for every u in `fields`, whatever the other symbols are, as far as the form of W shows: sums and products
// of even powers, rising functions of what grows outward (√(1 + p²), cosh q, 1 − sech q), what is convex and at rest at
// 0 (eᵘ − u − 1), and forms ½uᵀAu with bounded coefficients in the other symbols that keep A ⪰ 0. False says that the
// form does not show it. Hold an AlgebraLock.
bool grows_outward(const Expression& w, const Symbols& fields);

}  // namespace seiche
