// How large the error of a step is.
#pragma once

#include <seiche/core/phi.hpp>
#include <seiche/core/step_cache.hpp>
#include <seiche/core/system.hpp>

namespace seiche {

// The max norm of physical values. Of gradient flows in their own time: an error e made while ‖z‖ moves by the share ρ
// of itself counts as
//   4h |e + ρ⁻¹φ₁(τL)e|,  τ ≈ hρ^{−3/4}:
// as 4h e/ρ where L forgets nothing, and as little as 4h e where it damps by e⁻¹ within a fraction of the step. Divided
// by h, as errors are, these add up over the path, which has an end, and not over the time, which may be as long as one
// likes: a gradient flow rests for most of it. ρ ≥ 1e-3, so that rest does not cost. τ < h/ρ and the factor 4 are from
// runs of test/loop/gradient_flow_tolerance_test.cpp: what L forgets has moved other modes before. Backends without
// tables of φ take τ = h, and thus somewhat shorter steps. A field with a large constant part moves by a small share.
// What round-off in z is of e is left out, since at rest 1/ρ would make a lot of it.
class ErrorMeasure {
 public:
  ErrorMeasure(const System& system, const PhiEvaluator* phi);  // which outlive it; phi: null if no gradient flow

  bool is_of_gradient_flow() const { return is_gradient_flow_; }
  // The step whose errors are measured next.
  void start(const Vector& before, const Vector& after, double h);
  double operator()(const Vector& e);    // infinite where e is not finite
  double most() const { return most_; }  // of the measure over |e|, in the Euclidean norm

 private:
  const System& system_;
  const PhiEvaluator* phi_;
  bool is_gradient_flow_;
  double h_ = 0, moved_ = 1, most_ = 1, round_off_ = 0;  // moved_: ρ
  StepCache<PhiMap> forgetting_;                         // by τ
  Vector sum_, physical_;
};

}  // namespace seiche
