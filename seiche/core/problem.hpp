// An equation ż = S∇H(z) − D(t)z on a grid, stated by stencils, a potential and z₀; it knows no backend.
#pragma once

#include <seiche/core/grid.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/core/rate.hpp>
#include <seiche/core/stencil.hpp>

#include <memory>
#include <string>
#include <vector>

namespace seiche {

// D(t) = constant + γ(t) P, where P projects on the fields marked in `rate_fields`.
struct LinearDamping {
  BlockStencil constant;
  RatePointer rate;  // null: no such part
  std::vector<bool> rate_fields;

  bool is_zero() const { return constant.is_zero() && !rate; }
  bool moves(Index field) const;  // does field change under Ψ?
};

struct Problem {
  std::string name;
  Grid grid;
  std::vector<std::string> fields;  // z = (field 0 at all points, field 1 at all points, …)
  BlockStencil S, M;
  LinearDamping damping;
  std::shared_ptr<const PointwisePotential> potential;
  Index potential_field = 0;
  Vector initial;                  // physical values, fields × unknowns
  std::vector<std::string> notes;  // what was done on the way that the user should know

  Index field_count() const { return static_cast<Index>(fields.size()); }
  Index size() const { return field_count() * grid.unknowns(); }
};

// ż = S'∇H with S' = S − D: the form that the `whole` methods need. Possible where Dz = D∇H(z), that is where a
// constant D acts on fields with ∇_vH = v. Throws Error with the reason where it is not.
Problem with_damping_merged(const Problem& problem);

}  // namespace seiche
