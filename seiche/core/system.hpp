// The equation ż = S(z)∇H(z) − D(t)z − R(t, z) + f(t) in the coordinates of one backend.
#pragma once

#include <seiche/core/damping.hpp>
#include <seiche/core/external_force.hpp>
#include <seiche/core/grid/ranks.hpp>
#include <seiche/core/kicks.hpp>
#include <seiche/core/linear_part.hpp>
#include <seiche/core/numerics/linear_map.hpp>
#include <seiche/core/phi.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/core/problem.hpp>
#include <seiche/core/space.hpp>
#include <seiche/core/structure.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>

namespace seiche {

// ½zᵀMz and V(z), for those who need more than their sum.
struct EnergyTerms {
  ValueAndMagnitude quadratic, potential;
  double sum() const { return quadratic.value + potential.value; }
  double size() const { return quadratic.magnitude + std::abs(potential.value); }
  // 50ε times the sizes of the terms of H, and the least normal number, below which there are no relative errors: no
  // energy computed in double precision means more than this.
  double round_off() const {
    return 50 * epsilon * (2 * quadratic.magnitude + potential.magnitude) + std::numeric_limits<double>::min();
  }
};

struct System {
  std::unique_ptr<Space> space;
  std::unique_ptr<LinearPart> linear;
  std::unique_ptr<Potential> potential;
  std::unique_ptr<Damping> damping;                    // D and R
  std::unique_ptr<ExternalForce> force;                // f; null: none
  std::unique_ptr<Structure> structure;                // S(z) − S; null: S is all
  std::function<std::unique_ptr<Kicks>()> make_kicks;  // of z = (q, p), D = γ on p; or null
  // S∇V from physical values to physical values, where that takes no transform; null, or makes null: elsewhere.
  using NodalForce = std::function<void(const Vector& values, Vector& force)>;
  std::function<NodalForce()> make_nodal_force;
  std::function<std::unique_ptr<PhiEvaluator>()> make_phi;           // of L = SM − D₀; closures have no use for it
  std::function<std::unique_ptr<PhiEvaluator>()> make_undamped_phi;  // of L = SM
  // B of the noise that balances what dissipates for the length h (seiche/noise/fluctuation.hpp). Throws Error where
  // none does. Null: not by this backend.
  std::function<std::unique_ptr<LinearMap>(double h)> make_noise;
  Vector initial;    // z₀
  Index fields = 1;  // of equal size, one after the other in State::z

  double energy(const Vector& z) const { return linear->quadratic_energy(z) + potential->value(z); }
  EnergyTerms energy_terms(const Vector& z) const;
  void gradient(const Vector& z, Vector& out) const;  // ∇H
  // −dH/dt = ∇Hᵀ(Dz + R) − ∇HᵀS(z)∇H − ∇Hᵀf, from ∇V(z), which may be left zero where neither damping nor sym(S) nor f
  // sees it.
  struct Dissipation {
    double rate = 0.0;
    double work = 0.0;       // ∇Hᵀf, which `rate` holds with a minus
    double round_off = 0.0;  // 100ε times the sizes of its terms
  };
  Dissipation dissipation(double t, const Vector& z, const Vector& potential_gradient, Vector& scratch,
                          Vector& gradient_H) const;
  void right_hand_side(double t, const Vector& z, Vector& out) const;  // S(z)∇H − Dz − R + f
};

// S without what changes with the state:
bool is_skew(const System& system);
bool is_gradient_flow(const System& system);  // S = Sᵀ ≠ 0

// How the sparse backend takes exponentials: by Padé approximation with factorised matrices, or by Lanczos iteration.
enum class ExponentialKind { pade, lanczos };

inline constexpr int max_pade_degree = 12;  // beyond it, more steps cost less than a higher degree

struct SparseOptions {
  ExponentialKind exponential = ExponentialKind::pade;
  int pade_degree = 0;        // 1 … 12; 0: whatever round-off asks for
  int lanczos_dimension = 0;  // pairs of vectors, ≥ 2; 0: until nothing changes
  std::string solver = {};    // of petsc: options of its linear solvers; "": those of PETSC_OPTIONS
  void validate() const;      // throws Error on a number outside these bounds
};

// How backends turn a Problem into arithmetic.
struct BackendOptions {
  bool measure_plans = false;  // FFTW: fastest plans instead of repeatable ones
  int threads = 1;             // of the modal backend, ≥ 1; results do not depend on it
  const Ranks* ranks =
      nullptr;  // who holds the rest of Problem::grid, which says which part is here; outlives the system
  SparseOptions sparse = {};
};

}  // namespace seiche
