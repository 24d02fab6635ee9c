#include <seiche/problem/common/wave.hpp>

namespace seiche {

Problem wave_problem(std::string name, const Grid& grid, const Stencil& stiffness, const DampingRate& gamma) {
  Problem p;
  p.name = std::move(name);
  p.grid = grid;
  p.fields = {"u", "v"};
  p.S = BlockStencil(2);
  p.S(0, 1) = Stencil::identity();
  p.S(1, 0) = Stencil::identity(-1);
  p.M = BlockStencil(2);
  p.M(0, 0) = stiffness;
  p.M(1, 1) = Stencil::identity();
  p.damping = rate_damping(gamma, grid, {false, true});
  p.initial = Vector::Zero(p.size());
  return p;
}

LinearDamping rate_damping(const DampingRate& gamma, const Grid& grid, std::vector<bool> fields) {
  const RatePointer& uniform = gamma.uniform;
  const bool undamped = uniform && uniform->is_constant() && uniform->value(0) == 0;
  return {.constant = BlockStencil(static_cast<Index>(fields.size())),
          .rate = undamped ? nullptr : uniform,
          .field_rate = gamma.varying ? gamma.varying->on(grid) : nullptr,
          .rate_fields = std::move(fields)};
}

Vector sample(const Grid& grid, const std::function<double(double)>& f) {
  Vector values(grid.unknowns());
  for (Index i = 0; i < values.size(); ++i) values[i] = f(grid.coordinate(i, 0));
  return values;
}

double squared_distance_from_centre(const Grid& grid, Index point) {
  double squared = 0;
  for (Index a = 0; a < grid.dimension(); ++a) squared += square(grid.coordinate(point, a) - grid.axis(a).length / 2);
  return squared;
}

}  // namespace seiche
