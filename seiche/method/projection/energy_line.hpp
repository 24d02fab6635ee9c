// H on a line through a state.
#pragma once

#include <seiche/core/system.hpp>

#include <cmath>
#include <optional>
#include <vector>

namespace seiche {

// What lines of one system share.
struct EnergyLineScratch {
  explicit EnergyLineScratch(const System& system);
  Vector d, gradient, trial;
  std::vector<double> V;  // coefficients of x ↦ V(xz), where V is a polynomial
};

// λ ↦ H(z + λd). On the ray d = z it is known in powers of 1 + λ, all of one sign where V has one power only; on other
// lines it is evaluated at z + λd itself, since the terms of a polynomial in λ may be far larger than H.
class EnergyLine {
 public:
  enum class Direction {
    casimir_free,  // d = z − Πz, Π the projector on the linear Casimirs
    ray,           // d = z
    steepest,      // d ∝ ∇H(z) without its Casimir part, as long as z
  };
  struct Known {  // of z
    ValueAndMagnitude K;
    double V = 0;
  };
  // All outlive the line; one line of a scratch at a time.
  EnergyLine(const System& system, const PhiEvaluator& phi, EnergyLineScratch& scratch, const Vector& z,
             Direction direction, const std::optional<Known>& known = {});

  struct Parts {  // of H at one point
    double lambda = 0;
    double K = 0, V = 0;
    double size = 0;  // of the terms of K and V, as far as they are known one by one
    double H() const { return K + V; }
    double values() const { return std::abs(K) + std::abs(V); }
    double round_off() const { return 4 * epsilon * values(); }  // to be hoped for
    double loss() const { return 16 * epsilon * size; }          // to be put up with
  };
  Parts at(double lambda);

  struct Slope {
    double value = 0, size = 0;  // size: the sum of its terms without their signs
  };
  // dH/dλ at 0. But on a ray where V is a polynomial the first call takes a gradient.
  Slope slope();

  void move(Vector& z, double lambda) const;                               // z is the vector of the line
  double factor(double lambda) const { return is_ray_ ? 1 + lambda : 0; }  // of z; 0: that is no multiple of it
  const Vector& direction() const { return is_ray_ ? z_ : scratch_.d; }

 private:
  void prepare_ray(const std::optional<Known>& known);
  void take_gradients();
  void turn_downhill(const PhiEvaluator& phi);

  const System& system_;
  EnergyLineScratch& scratch_;
  const Vector& z_;
  bool is_ray_, polynomial_;
  ValueAndMagnitude K_ = {};    // at λ = 0, on the ray
  std::optional<double> size_;  // of the terms of H at λ = 0
  std::optional<Slope> slope_;
};

}  // namespace seiche
