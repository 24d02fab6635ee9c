// One method on up to sixteen members at once. The arithmetic of each lane is that of the ordinary stepper, in another
// order of summation.
#pragma once

#include <seiche/core/state.hpp>
#include <seiche/core/stepper.hpp>
#include <seiche/ensemble/lane_system.hpp>
#include <seiche/ensemble/row_loops.hpp>

#include <array>
#include <memory>
#include <vector>

namespace seiche {

struct LaneState {
  Panel z;  // (z, g): below z there is room for a gradient
  LaneValues r_squared{}, shift{}, energy_scale{};
};

// What a step has to say about each lane. `trouble` ≠ 0: the lane could not be stepped, or should not have been; the
// ordinary stepper is to say what is the matter, and may still manage.
struct LaneReport {
  LaneValues trouble{};
  std::array<int, lanes> scalar_iterations{};
  std::array<int, lanes> fallbacks{};
};

class LaneStepper {
 public:
  LaneStepper(std::unique_ptr<LaneSystem> system, const MethodEntry& method);
  LaneStepper(const LaneStepper&) = delete;
  LaneStepper& operator=(const LaneStepper&) = delete;
  virtual ~LaneStepper() = default;

  // Between a lane and what the ordinary stepper keeps of a state (z and the scalars; not t and n).
  void load(const State& state, Index lane);
  void store(Index lane, State& state) const;  // the state before the step until `accept`

  // From t to t + h. The result counts from `accept` on; until then it may be mended, lane by lane, with `mend`.
  void step(double t, double h, LaneReport& report);
  void mend(const State& state, Index lane);
  void accept();

  void energy(std::array<EnergyReading, lanes>& readings);

 protected:
  // next = Λ(Hamiltonian substep of s), with Λ a factor for every row: a half-flow on the way. Lanes with numbers that
  // are not finite are in trouble.
  virtual void advance(LaneState& s, const LaneStep& maps, RowFactors after, LaneState& next, LaneReport& report) = 0;
  // A half-flow with what the closure carries beside z; where `damps_z_only`, that is nothing.
  virtual void damp(LaneState& s, double t, double h) { flow(s, t, h); }
  virtual bool damps_z_only() const { return true; }
  virtual void modified_energy(const LaneState&, const LaneValues&, std::array<EnergyReading, lanes>&) {}

  LaneSystem& system() { return *system_; }
  const LaneSystem& system() const { return *system_; }
  void flow(LaneState& s, double t, double h);                   // z ← Ψ(t, t + h)z, half of the step h of `step`
  const LaneValues& twice_quadratic_energy(const LaneState& s);  // zᵀMz at the start of the substep
  double* gradient_of(LaneState& s) { return s.z.row(system_->size()); }
  double* values() { return values_.row(0); }  // of V's fields on the grid
  double* slopes() { return slopes_.row(0); }  // likewise
  void potential_of(const LaneState& s, LaneValues& v, LaneValues& magnitude);

 private:
  std::unique_ptr<LaneSystem> system_;
  // Factors for every row, one set for each half-flow.
  struct Decay {
    std::vector<LaneValues> of_field;
    std::vector<const double*> of_row;
    double h = -1.0;
  };
  RowFactors factors(Decay& decay, double t, double h);
  void apply_flow(const BlockMap& flow, LaneState& s);
  void set_rows(Decay& decay);

  bool splits_damping_;
  double step_size_ = 0.0;
  Decay none_, before_, after_;
  LaneValues quadratic_{};
  bool is_measured_ = false;  // is quadratic_ that of the substep?
  LaneState first_, second_, work_;
  LaneState* state_ = &first_;  // before the step
  LaneState* next_ = &second_;  // after it
  Panel values_, slopes_, moved_;
};

// Null where the method is not written for lanes, or the members do not allow it (LaneSystem::make).
std::unique_ptr<LaneStepper> make_lane_stepper(LaneSimulations members, const MethodOptions& options);

}  // namespace seiche
