// How large the error of a step is.
#pragma once

#include <seiche/core/phi.hpp>
#include <seiche/core/step_cache.hpp>
#include <seiche/core/system.hpp>

namespace seiche {

// The max norm of physical values. Of gradient flows in their own time: an error e made while the solution moves by the
// share ρ of itself counts as
//   4h |e + ρ⁻¹φ₁(τL)e|,  τ = h ρ^{−3/4}:
// as 4h e/ρ where nothing forgets it until the solution has moved by all of itself, and as 4h e where L soon does.
// Divided by h, as errors are, these add up over the path, which has an end, and not over the time, which may be as
// long as one likes: a gradient flow rests for most of it. That τ is less than h/ρ, and the 4, are from runs of
// test/loop/gradient_flow_tolerance_test.cpp: what L forgets has moved other modes before.
class ErrorMeasure {
 public:
  ErrorMeasure(const System& system, const PhiEvaluator* phi);  // which outlive it; phi: null if no gradient flow

  // The step whose errors are measured next.
  void start(const Vector& before, const Vector& after, double h);
  double operator()(const Vector& e);    // infinite where e is not finite
  double most() const { return most_; }  // of the measure of an error whose max norm is one

 private:
  const System& system_;
  const PhiEvaluator* phi_;
  bool is_gradient_flow_;
  double h_ = 0, moved_ = 1, most_ = 1;  // moved_: ρ
  StepCache<PhiMap> forgetting_;         // by τ
  Vector sum_, physical_;
};

}  // namespace seiche
