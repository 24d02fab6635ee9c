// Euler's equations of a free rigid body with friction, L̇ = L × I⁻¹L − γL: a Poisson system with three unknowns.
#pragma once

#include <seiche/problem/problems.hpp>

#include <array>

namespace seiche {

struct RigidBody {
  std::array<double, 3> inertia = {1.0, 2.0, 3.0};  // principal moments, > 0
  DampingRate gamma = nullptr;                      // 1/time; null: none
};

// z = L, the angular momentum in the frame of the body; H = ½LᵀI⁻¹L, S(L)w = L × w, D = γI. With γ = 0 also |L|² stays.
// It starts near the middle axis, around which rotation is unstable.
Problem rigid_body(const RigidBody& options = {});

ProblemEntry rigid_body_entry();

}  // namespace seiche
