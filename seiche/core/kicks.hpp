// A splitting without exponentials.
#pragma once

#include <seiche/core/vector.hpp>

#include <span>

namespace seiche {

// Kicks and drifts of q̇ = p, ṗ = −F(q) − γp with F(q) = Kq + ∇V(q) and z = (q, p), where a backend has a way to make them in fewer
// passes over memory than products with its matrices would need.
class Kicks {
 public:
  virtual ~Kicks() = default;

  struct DriftAndKick {  // q ← q + length · p, p ← decay · p, and then p ← p − kick · F(q)
    double length, decay, kick;
  };
  struct Report {
    double taken = 0;   // from ½|p|² by the factors `decay`
    double kicked = 0;  // |p|² after the first kick
  };
  // out ← (q, p) of z after p ← p − first_kick · F(q) and the stages, of which there is one at least. out is not z.
  virtual Report split(double first_kick, std::span<const DriftAndKick> stages, const Vector& z, Vector& out) const = 0;
};

}  // namespace seiche
