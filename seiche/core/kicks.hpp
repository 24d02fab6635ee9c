// A splitting without exponentials.
#pragma once

#include <seiche/core/base/vector.hpp>

#include <span>

namespace seiche {

// Kicks and drifts of q̇ = p, ṗ = −F(q) − γp with F(q) = Kq + ∇V(q) and z = (q, p), where a backend has a way to make
// them in fewer passes over memory than products with its matrices would need.
class Kicks {
 public:
  virtual ~Kicks() = default;

  struct KickAndDrift {  // p ← p − kick · F(q), and then q ← q + length · p, p ← decay · p
    double kick, length, decay;
  };
  struct Report {
    double taken = 0;   // from ½|p|² by the factors `decay`
    double kicked = 0;  // |p|² after the first kick
  };
  // out ← (q, p) of z after the stages, of which there is one at least, and p ← p − last_kick · F(q). out is not z.
  virtual Report split(std::span<const KickAndDrift> stages, double last_kick, const Vector& z, Vector& out) const = 0;
};

}  // namespace seiche
