// V(u) = Σ_j W(u_j; x_j) with W by a formula in one or several fields and the place.
#pragma once

#include <seiche/core/grid/grid.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/formula/formula.hpp>

#include <memory>
#include <vector>

namespace seiche {

// W with its derivatives, all of them functions of the fields and then x, y, z; and what algebra has found out about
// it.
struct PointFormula {
  FormulaPointer value;
  std::vector<FormulaPointer> gradient;  // with respect to each field
  bool uses_place = false;
  int degree = 0;                             // as a polynomial in the fields; 0: not one
  int homogeneity = 0;                        // d if W(xu) = xᵈW(u); 0: no such d
  bool grows_outward = false;                 // u·∇W(u) ≥ 0 for all u, by the form of W
  std::vector<bool> grows_outward_from = {};  // the same of the fields from each one on, whatever the others are
};

// The mean gradient is ∫₀¹ ∇V(a + s(b − a)) ds for polynomials and for one field, and otherwise the discrete gradient
// of formula/expression_graph.
std::shared_ptr<const PointwisePotential> formula_potential(const PointFormula& w, const Grid& grid);

}  // namespace seiche
