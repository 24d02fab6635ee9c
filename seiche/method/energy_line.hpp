// H on a line through a state.
#pragma once

#include <seiche/core/system.hpp>

#include <array>
#include <cmath>
#include <vector>

namespace seiche {

// What lines of one system share: their vectors, and the coefficients of V where it is a polynomial.
struct EnergyLineScratch {
  explicit EnergyLineScratch(const System& system);
  Vector d, Md, trial;
  std::vector<double> V;  // of λ ↦ V(z + λd), or of x ↦ V(xz)
};

// λ ↦ H(z + λd). On the ray d = z it is written in powers of 1 + λ, so that nothing cancels near the origin.
class EnergyLine {
 public:
  enum class Direction {
    casimir_free,  // d = z − Πz, Π the projector on the linear Casimirs
    ray,           // d = z
    steepest,      // d ∝ ∇H(z) without its Casimir part, as long as z
  };
  // All outlive the line; one line of a scratch at a time.
  EnergyLine(const System& system, const PhiEvaluator& phi, EnergyLineScratch& scratch, const Vector& z,
             Direction direction);

  struct Parts {  // of H at one point
    double K = 0, V = 0;
    double size = 0;  // of the terms of V, as far as they are known one by one
    double H() const { return K + V; }
    double round_off() const { return 4 * epsilon * (std::abs(K) + std::abs(V)); }  // to be hoped for
    double loss() const { return 4 * epsilon * (std::abs(K) + size); }              // to be put up with
  };
  Parts at(double lambda) const;

  struct Slope {
    double value = 0, size = 0;  // size: the sum of its terms without their signs
  };
  // dH/dλ at 0, or its part from ½zᵀMz where the other would cost a gradient
  Slope slope() const;

  void move(Vector& z, double lambda) const;  // z is the vector of the line
  const Vector& direction() const { return is_ray_ ? z_ : scratch_.d; }

 private:
  const System& system_;
  EnergyLineScratch& scratch_;
  const Vector& z_;
  bool is_ray_, polynomial_;
  std::array<double, 3> K_{};
};

}  // namespace seiche
