// ẑ, the second-order approximation at the midpoint where every closure takes ĝ = ∇V(ẑ). No energy law depends on it.
#pragma once

#include <seiche/core/base/vector.hpp>
#include <seiche/core/propagator.hpp>
#include <seiche/core/state.hpp>
#include <seiche/core/system.hpp>
#include <seiche/method/common/method_options.hpp>

#include <algorithm>
#include <span>

namespace seiche {

// The arithmetic of the remembered predictor, for the lengths h₀, h₁, h₂ of the last steps: for one run and for the
// members of a panel.
namespace midpoint_memory {

inline double weight(std::span<const double> lengths, double h) {  // w
  return (h / 2 + lengths[0]) / (lengths[0] + lengths[1]);
}
// Of the second difference d = g₀ − g₁ − ratio·(g₁ − g₂).
inline double ratio(std::span<const double> lengths) { return (lengths[0] + lengths[1]) / (lengths[1] + lengths[2]); }
inline bool reaches(double weight) { return weight > 0 && weight <= 4; }  // a step not much longer than those before

// True if the last extrapolation missed little of what a step moves, from |F_{h/2}d|² and |ẑ − z⁻|² in V's components.
inline bool predicts_well(double missed, double moved) {
  constexpr double share = 0.75, most_missed = 0.05;
  return square(share) * missed <= square(most_missed) * moved;
}

// Steps that are to take the gradient yet, behind one more. One that missed took it already.
inline double resting(double before, bool has_missed) { return has_missed ? 1 : std::max(before - 1, 0.0); }

}  // namespace midpoint_memory

// gradient:    ẑ = e^{A/2}z⁻ + (h/2)φ₁(A/2)S∇V(z⁻), the paper's: two gradients a step.
// remembered:  the same with ḡ = g₀ + w(g₀ − g₁) in the place of ∇V(z⁻), for g₀, g₁ the gradients at the midpoints of
//              the last steps h₀, h₁ and w = (h/4 + h₀/2)/((h₀ + h₁)/2): the gradient in the middle of the first half
//              step, by Adams and Bashforth inside the exponential. One gradient a step, and errors of the same size.
//              Where steps do not resolve the solution the memory would feed on itself, and a guard takes ∇V(z⁻).
class MidpointPredictor {
 public:
  MidpointPredictor(const System& system, Predictor kind) : system_(system), kind_(kind) {}  // which outlives it

  void begin(State& s) const;
  // z_mid = ẑ of a step h from z⁻ = Λz, on the components that V depends on. V(Λz) = V(z).
  void predict(const State& s, const Propagator& propagator, double h, Vector& z_mid,
               Propagator::FieldFactors before = {});
  // Behind a step that succeeded: its ĝ goes into the memory of s, and g becomes some other vector of that size.
  void keep(State& s, double h, Vector& g) const;
  void discard() { discards_ = true; }  // the ĝ of this step is not that of its midpoint: the memory starts anew

 private:
  bool recall(const State& s, const Propagator& propagator, double h, Vector& z_mid, Propagator::FieldFactors before);
  Propagator::Recalled recall_unfused(const State& s, const Propagator& propagator, const Propagator::Gradients& memory,
                                      double h, Vector& z_mid, Propagator::FieldFactors before);
  double missed(const Propagator& propagator, const Propagator::Gradients& memory);
  void take_difference(const Propagator::Gradients& memory);
  template <class V>
  auto of_support(V& v) const {
    const Potential::Support support = system_.potential->support();
    return v.segment(support.begin, support.size);
  }

  const System& system_;
  Predictor kind_;
  bool has_missed_ = false, discards_ = false;      // in this step
  Vector difference_, pushed_, product_, at_rest_;  // where the propagator does not fuse it
};

}  // namespace seiche
