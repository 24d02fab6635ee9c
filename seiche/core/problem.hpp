// An equation ż = S(z)∇H(z) − D(t)z − R(t, z) + f(t), stated by stencils on a grid or by sparse matrices, a potential
// and z₀; it knows no backend.
#pragma once

#include <seiche/core/friction.hpp>
#include <seiche/core/grid/grid.hpp>
#include <seiche/core/grid/sparse_operators.hpp>
#include <seiche/core/grid/stencil.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/core/rate.hpp>
#include <seiche/core/structure.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace seiche {

// D = constant + (γ(t) + γ(x, t)) P, where P projects on the fields marked in `rate_fields`.
struct LinearDamping {
  BlockStencil constant;
  RatePointer rate = nullptr;             // γ(t); null: no such part
  FieldRatePointer field_rate = nullptr;  // γ(x, t); null: no such part
  std::vector<bool> rate_fields = {};
  // Of γ(x, 0) at the points of all processes; none: of those here.
  std::optional<double> mean_field_rate = {};
};

struct Problem {
  std::string name;
  Grid grid;
  std::vector<std::string> fields;  // z = (field 0 at all points, field 1 at all points, …)
  BlockStencil S, M;
  LinearDamping damping;
  FrictionPointer friction = nullptr;         // R, on the momenta of the problem; null: none
  std::vector<FieldRatePointer> forces = {};  // f(x, t) of every field, null for none; empty: none at all
  StructurePointer structure = nullptr;       // S(z) − S; null: the structure matrix is S
  std::vector<Stencil> derivatives = {};      // ∂ along each axis, where `structure` asks for them
  // Where coefficients change from point to point: S, M and the constant part of D as matrices. S, M and
  // damping.constant above are then zero blocks, and `grid` only counts and places the points.
  std::shared_ptr<const SparseOperators> matrices;
  std::shared_ptr<const PointwisePotential> potential;
  Index potential_field = 0;       // the first of the potential->fields() consecutive fields that V depends on
  Vector initial;                  // physical values, fields × unknowns
  std::vector<std::string> notes;  // what was done on the way that the user should know

  Index field_count() const { return static_cast<Index>(fields.size()); }
  Index size() const { return field_count() * grid.unknowns(); }
  bool potential_depends_on(Index field) const;
  bool has_damping() const;
  bool has_forces() const;
  bool has_constant_damping() const;      // beside γ
  bool damping_moves(Index field) const;  // true if the field changes under Ψ
  bool damping_moves_potential() const;   // true if V does
};

// What one of several processes holds of a problem on a whole grid of two or three axes. Throws Error where there is
// friction that depends on the place: that is to be made for the part of the grid.
Problem part_of(const Problem& whole, const Rank& here);
// The same of rates γ(x, t) and forces alone: at some of `of` points, from `first` on.
Problem with_rates_at_points(const Problem& problem, Index first, Index of);

// P of LinearDamping, ones on the diagonal in the rows of `rate_fields`: as a matrix of all unknowns, and as the block
// of every mode.
SparseMatrix rate_matrix(const Problem& problem);
Eigen::MatrixXcd rate_symbol(const Problem& problem);

// D₀, the constant damping that stands in for D(t) in the exponentials of L = SM − D₀: the constant part, γ(0) and the
// mean of γ(x, 0). What D(t) has beyond it, if anything, acts as a force.
double rate_of_D0(const Problem& problem);                     // γ(0) + mean γ(x, 0), the factor of P
double mean_field_rate(const Problem& problem);                // γ(x, 0), which it has
BlockStencil constant_damping(const Problem& problem);         // D₀; not for problems stated by matrices
SparseMatrix constant_damping_matrix(const Problem& problem);  // D₀; for problems stated by matrices

// ż = S'∇H with S' = S − D: the form that the `whole` methods need. Possible where Dz = D∇H(z), that is where a
// constant D acts on fields with ∇_vH = v. Throws Error with the reason where it is not.
Problem with_damping_merged(const Problem& problem);

}  // namespace seiche
