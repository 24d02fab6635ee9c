// Friction by formula: c(u, t, x)·v, or any r(v, u, t, x).
#pragma once

#include <seiche/core/friction.hpp>
#include <seiche/core/grid/grid.hpp>
#include <seiche/formula/formula.hpp>

namespace seiche {

// Of the variables v, u, t, x, y, z: a velocity, its coordinate, the time, the place. Which of them appear is for the
// caller to say, since a formula does not tell.
struct FrictionFormula {
  FormulaPointer formula;
  bool uses_u = true, uses_t = true, uses_place = true;
};

// c(u, t, x)·v, with the exact flow e^{−wch}; where c depends on t, at the middle of h. Where c < 0 it feeds energy, as
// in van der Pol's equation.
FrictionPointer position_friction(FrictionFormula c, const Grid& grid);

// r(v, u, t, x), by the midpoint discrete gradient v⁺ = v − wh r(m), m = (v + v⁺)/2, at the middle of h: ½v² falls by
// whr(m)m exactly. Where r rises with v there is one such v⁺; elsewhere one near v is taken, and NaN if none exists.
// Where r is stiff, wh r'(v) ≫ 2, the velocity changes its sign from step to step instead of coming to rest: the
// closed forms of frictions.hpp do not.
FrictionPointer formula_friction(FrictionFormula r, const Grid& grid);

}  // namespace seiche
