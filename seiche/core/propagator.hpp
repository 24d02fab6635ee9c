// The linear substep z⁺ = Ez + Ff for one step size h.
#pragma once

#include <seiche/core/vector.hpp>

#include <memory>
#include <vector>

namespace seiche {

enum class PropagatorKind { exponential, cayley };

// Contract, for A = hSM:  E = I + FM  and  F + Fᵀ + FᵀMF = 0 if S is skew, ⪯ 0 if sym(S) ⪯ 0.
// Every energy law of method/ follows from it alone; to what it holds, the law holds.
//   exponential: E = e^A,                F = hφ₁(A)S
//   cayley:      E = (I−A/2)⁻¹(I+A/2),   F = h(I−A/2)⁻¹S
class Propagator {
 public:
  virtual ~Propagator() = default;
  // ẑ, a second-order approximation at the midpoint, from z and ∇V(z).
  virtual void predict(const Vector& z, const Vector& gradient, Vector& z_mid) const = 0;
  virtual void increment(const Vector& z, Vector& dz) const = 0;  // FMz = (E − I)z
  virtual void force(const Vector& f, Vector& q) const = 0;       // Ff
};

class LinearPart;

// The propagators of all step sizes that a method asks for; the least recently used goes first.
class Propagators {
 public:
  Propagators(const LinearPart& linear, PropagatorKind kind, std::size_t capacity = 16);
  const Propagator& at(double h);

 private:
  struct Entry {
    double h;
    std::unique_ptr<Propagator> propagator;
  };
  const LinearPart& linear_;
  PropagatorKind kind_;
  std::size_t capacity_;
  std::vector<Entry> entries_;  // most recently used first
};

}  // namespace seiche
