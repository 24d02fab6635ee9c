// The last part of a step that keeps the law by projection: a point near ẑ with H = E*, on the line ẑ + λ(ẑ − Πẑ).
#pragma once

#include <seiche/method/projection/energy_interval.hpp>
#include <seiche/method/projection/energy_line.hpp>

#include <optional>

namespace seiche {

// Moves along z(λ) = z + λd with d = z − Πz, where Π projects on the linear Casimirs, which therefore stay: dH/dλ =
// dᵀ∇H is positive under the energy-compatible damping condition with D = I, so that the equation H(z(λ)) = E is well
// conditioned.
class EnergyProjection {
 public:
  // Of the terms of H in one step: by so much no solution grows that the step resolves.
  static constexpr double gross_growth = 1e6;

  // `system` and `phi` outlive the projection.
  EnergyProjection(const System& system, const PhiEvaluator& phi);

  double energy_of_rest() const { return rest_; }  // H(0)

  struct Outcome {
    bool admissible = false;    // H(z) ≤ cap, and z as good as it could be made
    bool by_bisection = false;  // nothing better was found
    int iterations = 0;
    double computed = 0;      // Ĥ, of the z that was passed
    double H = 0;             // of the z that came out; the target itself, where it was met to round-off
    double factor = 1;        // what came out is so many times the z that was passed; 0: no multiple of it
    double displacement = 0;  // Euclidean norm of the move
    double loss = 0;          // what round-off makes of H there
    double values = 0;        // |½ẑᵀMẑ| + |V(ẑ)|, of the z that was passed
    double terms = 0;         // the sizes of the terms of H, of the z that came out
  };
  // Ĥ = H(z); each `project` follows a `measure` of the same z. V: its potential energy, null where that is not known.
  double measure(const Vector& z, const double* V = nullptr);
  // H(z) = target to round-off by the secant method. Where H hardly changes along d the equation is ill-conditioned:
  // then z stays as it is if target < cap and H(z) ≤ cap, for the cap is the law; and otherwise it moves along ∇H. If
  // no iteration converges, to a point with H ≤ target between z and Πz, or z and 0. Fails, and leaves z anywhere, if
  // H(0) > cap and H(z) > cap. H ≤ cap is meant up to round-off: of the terms of H at z, or where |½zᵀMz| + |V| has
  // grown by more than `gross_growth` over target.terms, those before the step, of so many of these.
  Outcome project(Vector& z, const EnergyTarget& aim);
  // True if z, which came out of it, was moved by more than a tenth of its length; accurate steps move it by about
  // their error.
  bool moved_far(const Outcome& outcome, const Vector& z) const;

 private:
  bool knows_sizes(const EnergyTarget& aim) const;
  bool is_there(const EnergyTarget& aim);
  void begin_line(const Vector& z);
  bool solve(EnergyLine& line, EnergyLine::Parts here, const EnergyTarget& aim, Vector& z, Outcome& outcome);
  bool bisect(EnergyLine line, double goal, Vector& z, Outcome& outcome);

  const System& system_;
  const PhiEvaluator& phi_;
  double rest_;
  EnergyLineScratch scratch_;
  std::optional<EnergyLine> line_;          // that z of the last `measure` moves along, once it has to
  EnergyLine::Parts start_;                 // H at that z
  std::optional<EnergyLine::Known> known_;  // of that z
};

}  // namespace seiche
