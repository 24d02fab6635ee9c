// Everything that evolves; nothing that evolves hides elsewhere, so a copy of a State is a checkpoint.
#pragma once

#include <seiche/core/base/vector.hpp>
#include <seiche/core/control/archive.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

namespace seiche {

// ∇V at the midpoints of the last steps, the newest first, with the lengths of these steps: what the predictor
// "remembered" starts from.
struct MidpointMemory {
  static constexpr int depth = 3;  // two predict the next one, and the third tells how well

  std::vector<Vector> gradients = {};  // none where the predictor is another
  std::vector<double> lengths = {};
  int known = 0;    // of them; 0 after a start or restart
  int resting = 0;  // steps that are not to use them

  void archive(Archive& a) {
    a(gradients, lengths, known, resting);
    a.require(lengths.size() == gradients.size() && known >= 0 && known <= depth && resting >= 0 && resting <= depth);
    if (gradients.empty()) a.require(known == 0);
  }
};

struct State {
  Vector z;                  // in the coordinates of Space
  double t = 0.0;            // t₀ + n h for fixed steps
  std::int64_t n = 0;        // steps taken
  std::uint64_t stream = 0;  // of the random numbers, where there is noise: the member of an ensemble
  // Scalar auxiliary variable (sav family): r² = V + C along the exact solution, E₀ the energy scale of its guard.
  double r_squared = 0.0;
  double shift = 0.0;  // C
  double energy_scale = 0.0;
  // Methods that keep the law by projection, and multiplier closures where nothing changes H: what H(z) is to be, which
  // it is to round-off. The sav family where r² is relaxed: its modified energy.
  double energy = 0.0;
  double energy_terms = 0.0;  // the sizes of the terms of H(z), to which its round-off is relative
  // Collocation: the forces at the nodes of the last step, whose length was history_h; splittings that look at V where
  // they end: ∇V(z). Nothing is known, and history_h is 0, after a start or restart.
  std::vector<Vector> history = {};
  double history_h = 0.0;

  MidpointMemory midpoints = {};  // of closures

  // All of the above but vectors and what is known of earlier steps: a new number has its place here too.
  static auto numbers_of(auto& s) {
    return std::tie(s.t, s.n, s.stream, s.r_squared, s.shift, s.energy_scale, s.energy, s.energy_terms);
  }

  // Copies all but what is known of earlier steps. This state then knows of none, and keeps its own vectors for them.
  void start_from(const State& from) {
    z = from.z;
    numbers_of(*this) = numbers_of(from);
    history_h = 0;
    midpoints.known = midpoints.resting = 0;
  }

  // Read into a state of the same problem and method.
  void archive(Archive& a) {
    const Index size = z.size();
    const std::size_t nodes = history.size(), remembered = midpoints.gradients.size();
    a(z);
    std::apply(a, numbers_of(*this));
    a(history, history_h, midpoints);
    if (!a.reads()) return;
    if (history.empty() && nodes > 0) {  // written before this method kept any
      history.assign(nodes, Vector::Zero(size));
      history_h = 0;
    }
    a.require(z.size() == size && history.size() == nodes && midpoints.gradients.size() == remembered);
    for (const std::vector<Vector>* vectors : {&history, &midpoints.gradients})
      for (const Vector& force : *vectors) a.require(force.size() == size);
    a.require(n >= 0 && n < (std::int64_t{1} << 60) && std::isfinite(t) && z.allFinite());
  }
};

}  // namespace seiche
