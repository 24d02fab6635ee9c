#include <seiche/problem/wave.hpp>

namespace seiche {

Problem wave_problem(std::string name, const Grid& grid, const Stencil& stiffness, RatePointer gamma) {
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
  const bool undamped = !gamma || (gamma->is_constant() && gamma->value(0) == 0);
  p.damping = {.constant = BlockStencil(2),
               .rate = undamped ? nullptr : std::move(gamma),
               .rate_fields = {false, true}};
  p.initial = Vector::Zero(p.size());
  return p;
}

Vector sample(const Grid& grid, const std::function<double(double)>& f) {
  Vector values(grid.unknowns());
  for (Index i = 0; i < values.size(); ++i) values[i] = f(grid.coordinate(i, 0));
  return values;
}

}  // namespace seiche
