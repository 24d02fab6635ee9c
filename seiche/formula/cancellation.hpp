// Formulas that vanish at rest, written so that no digits are lost there.
#pragma once

#include <seiche/formula/formula_program.hpp>

#include <span>

namespace seiche {

// The same function, where sums lose their leading digits next to a point of rest or at infinity:
//   log(1 + x) → log1p(x)    eˣ − 1 → expm1(x)    1 − cos x → 2 sin²(x/2)    cosh x − 1 → 2 sinh²(x/2)
//   √(c + x) − √c → x/(√(c + x) + √c)    1 − tanh²x → sech²x
// also with factors, among other terms, and several at once: cosh p − cos q. Sums that are not exactly 0 at rest, and
// exponentials without a number beside them, which may be small far from rest, stay as they are, to the bit.
FormulaProgram without_cancellation(std::span<const Instruction> program);

}  // namespace seiche
