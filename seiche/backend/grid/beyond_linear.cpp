#include <seiche/backend/grid/beyond_linear.hpp>
#include <seiche/backend/grid/friction_damping.hpp>
#include <seiche/backend/grid/grid_force.hpp>
#include <seiche/backend/grid/grid_structure.hpp>

namespace seiche {

void add_beyond_linear(System& system, const Problem& problem, const std::shared_ptr<const FieldTransform>& transform,
                       FunctionRef<std::unique_ptr<LinearMap>()> make_derivative) {
  if (problem.friction)
    system.damping = std::make_unique<FrictionDamping>(problem, transform, std::move(system.damping));
  if (problem.has_forces()) system.force = std::make_unique<GridForce>(problem, transform);
  if (!problem.structure) return;
  auto derivative = problem.derivative.is_zero() ? nullptr : make_derivative();
  system.structure = std::make_unique<GridStructure>(problem, transform, std::move(derivative));
}

}  // namespace seiche
