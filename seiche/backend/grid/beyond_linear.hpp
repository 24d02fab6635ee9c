// What stands beside S∇H − D(t)z in a problem: friction, external forces, a structure matrix that changes with the
// state.
#pragma once

#include <seiche/backend/fft/transform.hpp>
#include <seiche/core/base/function_ref.hpp>
#include <seiche/core/numerics/linear_map.hpp>
#include <seiche/core/system.hpp>

#include <memory>

namespace seiche {

// Completes a system that has its linear damping. make_derivative(∂): one of problem.derivatives on the coordinates of
// one field. Throws Error where the problem has friction but no velocities.
void add_beyond_linear(System& system, const Problem& problem, const std::shared_ptr<const FieldTransform>& transform,
                       FunctionRef<std::unique_ptr<LinearMap>(const Stencil&)> make_derivative);

}  // namespace seiche
