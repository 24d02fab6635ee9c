// A problem written down: H, S and D by formulas, on a grid or for a few degrees of freedom.
#pragma once

#include <seiche/config/custom/custom_tables.hpp>
#include <seiche/core/problem.hpp>
#include <seiche/formula/formula_parser.hpp>
#include <seiche/problem/common/grid_options.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace seiche {

struct CustomProblem {
  std::vector<std::string> fields = {};  // empty: u, v on a grid and q, p without one
  std::optional<GridOptions> grid = {};  // none: a few degrees of freedom, and no place
  FormulaConstants parameters = {};      // numbers that the formulas may name
  // The energy of a point, in the fields, their derivatives u_x and u_xx, the place x, y, z, and on a line differences
  // du = u_{j+1} − u_j between neighbours. Quadratic terms with constant coefficients become ½zᵀMz, the others V.
  std::string H = {};
  // Or both apart: M by entries of numbers and derivatives (d_x, d_x^2, laplacian), and V in fields, place and
  // differences.
  FormulaTable M = {};
  std::string V = {};
  FormulaTable S = {};    // entries as for M; empty: [[0, I], [−I, 0]]
  FormulaTable D = {};    // the same, and on the diagonal also rates in t and place; empty: no damping
  bool is_trial = false;  // on a grid of a few points, to read the formulas: what they give there is not looked at
  std::map<std::string, std::string> initial = {};  // a formula in x, y, z and j for every field; empty: zero
};

// Its first note says the split into ½zᵀMz and V. Throws Error with the place in the formula where one cannot be read,
// where the tables do not fit the fields, where no M ⪰ 0 can be found, or where V has no finite force at the initial
// state.
Problem custom_problem(const CustomProblem& custom);

}  // namespace seiche
