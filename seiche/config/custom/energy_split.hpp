// The formula of an energy, taken apart: quadratic terms for ½zᵀMz, the rest for V, per point and per bond.
#pragma once

#include <seiche/core/potential.hpp>
#include <seiche/formula/formula_parser.hpp>
#include <seiche/potential/formula_potential.hpp>

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace seiche {

// What a formula may name beside constants: the fields; x, y, z of a grid; derivatives u_x, u_xx; and du, the
// difference u_{j+1} − u_j, on a line.
struct EnergyNames {
  std::vector<std::string> fields;
  Index axes = 0;  // of the grid; 0: there is no place
  NameAdvice advice = {};
};

// coefficient · a · b
struct QuadraticTerm {
  struct Factor {
    enum class Kind { value, first, second, bond };  // u, u_x, u_xx, du
    Index field = 0;
    Kind kind = Kind::value;
    Index axis = 0;
  };
  Factor a, b;
  double coefficient = 0.0;
};

// W of `count` fields from `field` on.
struct FieldFormula {
  Index field = 0;
  Index count = 1;
  PointFormula w = {};
  std::vector<double> polynomial = {};  // W(u) = Σ cᵢuⁱ, of one field without a place; else empty
  std::vector<double> of_modulus = {};  // W(u, v) = Σ cᵢ(u² + v²)ⁱ; else empty
};

struct EnergySplit {
  std::vector<QuadraticTerm> quadratic;
  std::vector<FieldFormula> per_point;    // none or one
  std::vector<FieldFormula> per_bond;     // of one field each
  std::string quadratic_text, rest_text;  // to be shown
  std::string left_out_text;              // what moves nothing, where there is no V to count it with
};

// Which quadratic terms go into ½zᵀMz: all with constant coefficients but those of the given pairs of fields (i ≤ j),
// or none.
struct QuadraticTerms {
  bool found = true;
  std::set<std::pair<Index, Index>> left_in_V = {};
};

// `key` is how errors call the formula. Throws Error where it cannot be read, with the place in it, and where it is no
// energy: derivatives that are not squared, bonds mixed with points.
EnergySplit split_energy(const std::string& key, const std::string& text, const EnergyNames& names,
                         const FormulaConstants& constants, const QuadraticTerms& quadratic);

}  // namespace seiche
