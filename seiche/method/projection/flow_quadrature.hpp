// How well a quadrature of the dissipation resolves the linear flow inside a step.
#pragma once

#include <seiche/core/step_cache.hpp>
#include <seiche/core/system.hpp>

#include <Eigen/Dense>

#include <memory>

namespace seiche {

// Along x(t) = e^{tL}z + tφ₁(tL)n, the flow under the force of the step's start, the linear part Q(x) of the
// dissipation has an integral that is known exactly. Two quadratures that both step over an initial layer, or over the
// period of an oscillation, agree with each other and not with this. Costs no gradient of V.
class FlowQuadrature {
 public:
  // Σ h weights_i f(nodes_i) ≈ ∫₀ʰ f. n is a state, or a gradient with S before it. `phi` outlives it.
  FlowQuadrature(const System& system, const PhiEvaluator& phi, PhiRows::Forces kind, Eigen::VectorXd nodes,
                 Eigen::VectorXd weights);

  // The quadrature of Q along x minus its integral; 0 where that is no more than round-off of terms of H of this size.
  double miss(double h, const Vector& z, const Vector& n, double terms);
  // True if the nodes follow the fastest rate of the flow: then they miss far less than a rule of fewer nodes does, and
  // `miss` is not needed. With m nodes the error is of the order of (m!)⁴/((2m + 1)(2m)!³) (2hρ)²ᵐ for a rate ρ.
  bool resolves(double h) const { return h * phi_.rate() <= 2; }
  void prepare(double h) {  // so that `miss` allocates nothing
    if (!resolves(h)) error(h);
  }

 private:
  const PhiForms& error(double h);

  const PhiEvaluator& phi_;
  PhiRows::Forces kind_;
  Eigen::VectorXd nodes_, weights_;
  StepCache<PhiForms> cache_;
};

}  // namespace seiche
