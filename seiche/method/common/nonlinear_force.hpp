// What drives z beside Lz, for methods that take L = SM − D₀ into exponentials.
#pragma once

#include <seiche/core/base/function_ref.hpp>
#include <seiche/core/system.hpp>

namespace seiche {

// N(t, z) = S∇V − (D(t) − D₀)z − R(t, z) + f(t) + (S(z) − S)∇H; or, where that is S∇V, only ∇V(z): then φ-maps multiply
// by S.
class NonlinearForce {
 public:
  explicit NonlinearForce(const System& system);               // which outlives it
  NonlinearForce(const System& system, PhiRows::Forces kind);  // states: always N itself

  static PhiRows::Forces kind_of(const System& system);
  PhiRows::Forces kind() const { return kind_; }  // what PhiRows is to say of these forces

  using Look = FunctionRef<void(const Vector& z, const Vector& potential_gradient)>;
  double evaluate(double t, Vector& z);           // z ← N(t, z), or ∇V(z); returns V(z)
  void evaluate(double t, Vector& z, Look look);  // the same, after a look at z and ∇V(z)

  // The norm of f at a time, which no state and no force at another time determines; 0 without external forces.
  double external(double t);

 private:
  void complete(double t, Vector& z);  // from gradient_ = ∇V(z)

  const System& system_;
  PhiRows::Forces kind_;
  Vector gradient_, rest_;      // ∇V is zero outside its support
  Vector gradient_H_, turned_;  // where S changes with z
};

}  // namespace seiche
