// Propagators over modes: one fused pass for each verb of an explicit step.
#pragma once

#include <seiche/backend/modal/mode_arrays.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/core/propagator.hpp>
#include <seiche/core/space.hpp>

#include <memory>

namespace seiche {

// M where it is diagonal: a real factor per mode and field; the identity on the fields of `unit` (bits).
struct ModalMetric {
  ModeArrays factors;  // fields × 1
  unsigned unit = 0;
};

struct ModalForceMaps {
  ModeArrays F, Q;  // fields × fields; Q is that of ẑ = z + Q(Mz + ∇V)
};

struct ModalExtent {
  Index fields, modes;
  ModeLayout layout;
  Index first, count;  // the fields that V depends on
  int threads;

  Index slots() const { return modes * slots_per_mode(layout); }
};

// Whether there are passes for such fields; otherwise ModeMap serves, entry by entry.
bool has_fused_propagator(const ModalExtent& extent, unsigned unit);

// `space` and `metric` outlive the propagator.
std::unique_ptr<Propagator> fused_propagator(const Space& space, const ModalExtent& extent, const ModalMetric& metric,
                                             ModalForceMaps maps);

// Σ M z² over the slots of one field that this process holds; null M: the identity.
double weighted_square(ModeLayout layout, const double* M, const double* z, Index slots);
// out ← M z over the slots of one field.
void multiply_modes(ModeLayout layout, const double* M, const double* z, Index slots, double* out);

}  // namespace seiche
