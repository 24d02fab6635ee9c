// Entries of S, M and D by formula: numbers and derivatives, and for damping also rates that change with t and place.
#pragma once

#include <seiche/core/grid/grid.hpp>
#include <seiche/core/grid/stencil.hpp>
#include <seiche/formula/formula_parser.hpp>

#include <string>

namespace seiche {

struct OperatorFormula {
  Stencil stencil;   // what is constant
  std::string rate;  // a formula in t, x, y, z: what is not; "": nothing
};

// Names are d_x, d_y, d_z (derivatives, also as powers: d_x^2), laplacian, the wave numbers k_x, k_y, k_z and their
// length k (in functions, which need the spectral discretisation: sqrt(tanh(k)/k) multiplies every mode by that), and
// constants; with `may_vary` also t, x, y, z. A constant named like a wave number is the constant. A grid without a
// place (`axes` = 0) has no derivatives. Throws Error with the place in the formula, or for what no difference is
// there: products of derivatives along different axes, more than four.
OperatorFormula compile_operator(const std::string& key, const std::string& text, const Grid& grid, Index axes,
                                 Discretisation discretisation, const FormulaConstants& constants, bool may_vary,
                                 const NameAdvice& advice = {});

// True if two rates in t, x, y, z are the same function, as far as algebra shows it.
bool is_one_rate(const std::string& a, const std::string& b, const FormulaConstants& constants);

}  // namespace seiche
