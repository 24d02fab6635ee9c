// The equation ż = S∇H(z) − D(t)z in the coordinates of one backend.
#pragma once

#include <seiche/core/damping.hpp>
#include <seiche/core/linear_part.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/core/problem.hpp>
#include <seiche/core/space.hpp>

#include <memory>
#include <string>

namespace seiche {

struct System {
  std::unique_ptr<Space> space;
  std::unique_ptr<LinearPart> linear;
  std::unique_ptr<Potential> potential;
  std::unique_ptr<Damping> damping;
  Vector initial;  // z₀

  double energy(const Vector& z) const { return linear->quadratic_energy(z) + potential->value(z); }
  // 50ε times the sizes of the terms of H: no energy computed in double precision means more than this.
  double energy_round_off(const Vector& z) const;
  void gradient(const Vector& z, Vector& out) const;                   // ∇H
  void right_hand_side(double t, const Vector& z, Vector& out) const;  // S∇H − Dz
};

// How backends turn a Problem into arithmetic.
struct BackendOptions {
  bool measure_plans = false;  // FFTW: fastest plans instead of repeatable ones
};

}  // namespace seiche
