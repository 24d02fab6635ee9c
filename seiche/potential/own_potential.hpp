// A potential by two functions of the user's own.
#pragma once

#include <seiche/core/potential.hpp>

#include <functional>
#include <memory>

namespace seiche {

// V(u) and ∇V(u) on the physical values u of one field, or of several one after the other. Both are called on the
// thread that steps, one call at a time. What they throw comes out of whatever asked for V.
struct OwnPotential {
  std::function<double(std::span<const double> u)> value;
  std::function<void(std::span<const double> u, std::span<double> gradient)> gradient;
  Index fields = 1;            // how many consecutive ones u holds
  bool grows_outward = false;  // u·∇V(u) ≥ 0 for every u, which only the user knows
};

// The mean gradient is a Gauss quadrature with four nodes, moved along b − a to mean·(b − a) = V(b) − V(a) where it
// misses that by more than round-off. Throws Error where a function is missing; the first run asks for
// gradient_complaint at its initial state, and does not begin where there is one.
std::shared_ptr<const PointwisePotential> own_potential(OwnPotential own);

// "the gradient is not that of V: …" where a slope of V by differences is not what `gradient` says: at u and at three
// random states of its size (of size 1 where u = 0), component by component, of more than 64 at so many and at their
// sum with random signs. "" where it is, or where V is no finite number nearby. What the functions throw at u comes
// out; that V does not exist at a random state is no complaint.
std::string gradient_complaint(const OwnPotential& own, std::span<const double> u);

// What V is computed to: ε, or that of single precision where its values around u have no more digits.
double relative_precision(const OwnPotential& own, std::span<const double> u);

}  // namespace seiche
