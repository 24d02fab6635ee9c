// What stands beside S∇H − D(t)z in a problem: friction, external forces, a structure matrix that changes with the state.
#pragma once

#include <seiche/backend/linear_map.hpp>
#include <seiche/backend/transform.hpp>
#include <seiche/core/system.hpp>

#include <memory>

namespace seiche {

// Completes a system that has its linear damping. `derivative`: ∂ on the coordinates of one field, null where the problem has
// none. Throws Error where the problem has friction but no velocities.
void add_beyond_linear(System& system, const Problem& problem, const std::shared_ptr<const FieldTransform>& transform,
                       std::unique_ptr<LinearMap> derivative);

}  // namespace seiche
