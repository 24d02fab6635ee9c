// Positions, which V depends on, and momenta, which it does not: how S, M and D couple them.
#pragma once

#include <seiche/core/system.hpp>

#include <optional>

namespace seiche {

// Asked of the operators themselves: each statement "A maps this part into that one" is tried on one vector without a
// zero, for which another A would have to be made.
struct MomentumForm {
  Potential::Support
      positions;           // those that V depends on; the first half of z where that makes a separable form or V = 0
  bool kicks = false;      // S∇V moves momenta alone: the flow of ż = S∇V(z) is a kick
  bool separable = false;  // H = T(v) + U(u), and S couples u with v alone
  bool canonical = false;  // separable, T = ½|v|², u' = v and v' = −∇U, component by component
  std::optional<double> rate = {};  // γ, where D is γ on momenta and 0 on positions, at any time
};
MomentumForm momentum_form(const System& system);

// after ← before + a Sg for gradients g of V, which are zero outside the positions.
class MomentumKick {
 public:
  MomentumKick(const System& system, const MomentumForm& form);  // the system outlives it

  void apply(double a, const Vector& g, const Vector& before, Vector& after);  // which may be one
  double lift(double a, const Vector& g, Vector& z);  // the same of z alone; by how much that raises ½zᵀMz
  double length(const Vector& g);                     // |Sg|

 private:
  const System& system_;
  Potential::Support positions_;
  bool is_canonical_;
  Vector kick_, middle_, product_;  // where it is not
};

}  // namespace seiche
