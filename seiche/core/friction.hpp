// Damping beyond linear, −R(t, q, v) on the momenta of a mechanical system.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace seiche {

// At every point a coordinate q and a velocity v, or several of each: `components` fields, one after the other in the
// spans. R acts at every point alone, and lowers the energy where v·R ≥ 0.
class Friction {
 public:
  virtual ~Friction() = default;
  // r ← R(t, q, v)
  virtual void force(double t, std::span<const double> q, std::span<const double> v, std::span<double> r) const = 0;
  // v ← its value at t + h along v̇ = −wR(t, q, v), w > 0, with q held: exactly, or by a map that does not raise |v|
  // where v·R ≥ 0. NaN where there is no such value.
  virtual void flow(double t, double h, double w, std::span<const double> q, std::span<double> v) const = 0;
  virtual bool uses_coordinates() const = 0;  // q; else it is not looked at
  virtual bool uses_place() const { return false; }
  virtual bool is_dissipative() const = 0;  // v·R ≥ 0 everywhere, by the form of R
  // How smooth R is at v = 0, as far as its form tells: with a kink in the first derivative no method is of more than
  // some order three; what turns sharply there, or jumps, is for exact flows; and where it jumps, errors of a step are
  // of the size of the step while a velocity stays at 0, so that no tolerance can be asked for.
  enum class Smoothness { smooth, kink, sharp, jump };
  virtual Smoothness smoothness() const { return Smoothness::smooth; }
  virtual double steepness() const { return 0; }  // of what turns sharply: dR/dv at v = 0, in 1/time
  // "v = 0.5, t = 0": where v·R < 0, so that R feeds energy, among the places tried up to t_end; "" if none was found.
  virtual std::string feeds_at(double t_end) const = 0;
  // The same among all places met so far: trying may miss one.
  virtual std::string fed_at() const = 0;
  // How often a flow of the user's own raised |v|, and was scaled back.
  virtual std::int64_t corrections() const { return 0; }
  virtual std::string text() const = 0;  // "0.3 |v|v"

  // The same R with a memory of its own for `fed_at` and `corrections`; null where nothing is remembered, and this one
  // may be shared.
  virtual std::shared_ptr<const Friction> with_own_memory() const { return nullptr; }
  virtual void forget_fed() const {}  // const as remembering is
  // A sentence about `fed_at`, or "".
  std::string complaint() const {
    const std::string place = fed_at();
    return place.empty() ? "" : "the friction " + text() + " feeds energy at " + place;
  }
};

using FrictionPointer = std::shared_ptr<const Friction>;

}  // namespace seiche
