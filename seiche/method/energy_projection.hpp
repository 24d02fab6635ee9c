// The last part of a step that keeps the law by projection: the point near ẑ where H is what it is to be.
#pragma once

#include <seiche/core/system.hpp>

#include <vector>

namespace seiche {

// Moves along z(λ) = z + λd with d = z − Πz, where Π projects on the linear Casimirs, which therefore stay: dH/dλ = dᵀ∇H is
// positive under the energy-compatible damping condition with D = I, so that the equation H(z(λ)) = E is well conditioned.
class EnergyProjection {
 public:
  // `system` and `phi` outlive the projection.
  EnergyProjection(const System& system, const PhiEvaluator& phi);

  double energy_of_rest() const { return rest_; }  // H(0)

  struct Outcome {
    bool admissible = false;    // H(z) ≤ cap, and z as good as it could be made
    bool H_is_target = false;   // to round-off
    bool by_bisection = false;  // the secant iteration did not find E
    int iterations = 0;
    double H = 0;
  };
  // H(z) = target to 4ε(½zᵀMz + |V|) by the secant method. z stays as it is where H hardly changes along the line and
  // H(z) ≤ cap: the equation is then ill-conditioned, and the cap is the law. Where the iteration fails, a point with
  // H ≤ target between z and Πz, or z and 0. Fails, and leaves z anywhere, if H(0) > cap and H(z) > cap.
  Outcome project(Vector& z, double target, double cap);

 private:
  struct Parts {  // of H at one point
    double K = 0, V = 0;
    double H() const { return K + V; }
    double round_off() const { return 4 * epsilon * (std::abs(K) + std::abs(V)); }
  };
  class Line;

  const System& system_;
  const PhiEvaluator& phi_;
  double rest_;
  Vector d_, Md_, trial_;
  std::vector<double> V_along_;  // coefficients of λ ↦ V(z + λd), where V is a polynomial
};

}  // namespace seiche
