// How well a quadrature of the dissipation resolves the linear flow inside a step.
#pragma once

#include <seiche/core/step_cache.hpp>
#include <seiche/core/system.hpp>

#include <Eigen/Dense>

#include <memory>
#include <optional>

namespace seiche {

// Along x(t) = e^{tL}z + tφ₁(tL)n, the flow under the force of the step's start, the linear part of the dissipation is
// known exactly:
//   ∫₀ʰ Q dt = ½zᵀMz − ½x(h)ᵀMx(h) + nᵀM∫₀ʰ x dt,   Q(x) = xᵀ(sym(MD₀) − M sym(S) M)x.
// Two quadratures that both step over an initial layer, or over the period of an oscillation, agree with each other and
// not with this. Costs no gradient of V.
class FlowQuadrature {
 public:
  // Σ h weights_i f(nodes_i) ≈ ∫₀ʰ f. `system` and `phi` outlive it.
  FlowQuadrature(const System& system, const PhiEvaluator& phi, Eigen::VectorXd nodes, Eigen::VectorXd weights);

  // The quadrature of Q along x minus its integral; 0 where that is no more than round-off. n, a state, is read only.
  double miss(double h, const Vector& z, const Vector& n);
  // Do the nodes follow the fastest rate of the flow? Then what they miss is far less than what a rule of fewer nodes
  // does, and nobody need ask. With m nodes the error is of the order of (m!)⁴/((2m + 1)(2m)!³) (2hρ)²ᵐ for a rate ρ.
  bool resolves(double h);
  void prepare(double h) {  // so that `miss` allocates nothing
    if (!resolves(h)) tables(h);
  }

 private:
  struct Tables {
    std::unique_ptr<PhiForms> quadrature;
    std::unique_ptr<PhiMap> end;       // x(h)
    std::unique_ptr<PhiMap> integral;  // ∫x
  };
  Tables& tables(double h);
  Tables make_tables(double h) const;

  const System& system_;
  const PhiEvaluator& phi_;
  Eigen::VectorXd nodes_, weights_;
  StepCache<Tables> cache_;
  std::optional<double> rate_;  // the fastest, once it is asked for
  std::vector<Vector> inputs_;  // z and n
  Vector x_, Mx_;
};

}  // namespace seiche
