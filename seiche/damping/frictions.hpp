// Friction beyond linear: the laws that have an exact flow, and maps of the user's own.
#pragma once

#include <seiche/core/friction.hpp>

#include <cstddef>
#include <functional>

namespace seiche {

// R at one component of the velocity; each has an exact flow. Coefficients are ≥ 0, `width` > 0; Error otherwise.
FrictionPointer quadratic_friction(double linear, double c);  // (linear + c|v|)v: drag
FrictionPointer cubic_friction(double c);                     // cv³
FrictionPointer saturating_friction(double c, double width);  // c tanh(v/width)
FrictionPointer dry_friction(double c);                       // c sgn(v), with v = 0 once it is reached
// c|v|v with |v| the Euclidean length of the velocity at a point, over so many components.
FrictionPointer isotropic_friction(double c, std::size_t components);

// A law given by functions: R, and its flow as in Friction::flow. Neither looks at coordinates unless it is said so.
// Where the flow raises Σv² it is scaled back to what it was, and counted.
struct OwnFriction {
  std::function<void(double t, std::span<const double> q, std::span<const double> v, std::span<double> r)> force;
  std::function<void(double t, double h, double w, std::span<const double> q, std::span<double> v)> flow;
  bool uses_coordinates = false;
  std::string text = "given by functions";
};
FrictionPointer own_friction(OwnFriction own);

}  // namespace seiche
