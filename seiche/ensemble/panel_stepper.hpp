// One method on up to sixteen members at once. The arithmetic of each member is that of the ordinary stepper, in
// another order of summation.
#pragma once

#include <seiche/core/state.hpp>
#include <seiche/core/stepper.hpp>
#include <seiche/ensemble/panel_predictor.hpp>
#include <seiche/ensemble/panel_system.hpp>
#include <seiche/ensemble/row_loops.hpp>

#include <array>
#include <memory>
#include <vector>

namespace seiche {

struct PanelState {
  Panel z;  // (z, g): below z there is room for a gradient
  PanelValues r_squared{}, shift{}, energy_scale{};
};

// What a step has to say about each member. `trouble` ≠ 0: the member could not be stepped, or should not have been;
// the ordinary stepper is to say what is the matter, and may still manage.
struct PanelReport {
  PanelValues trouble{};
  std::array<int, panel_members> scalar_iterations{};
  std::array<int, panel_members> fallbacks{};
};

class PanelStepper {
 public:
  PanelStepper(std::unique_ptr<PanelSystem> system, const MethodEntry& method, Predictor predictor);
  PanelStepper(const PanelStepper&) = delete;
  PanelStepper& operator=(const PanelStepper&) = delete;
  virtual ~PanelStepper() = default;

  // Between a member and what the ordinary stepper keeps of a state (z and the scalars; not t and n).
  void load(const State& state, Index member);
  void store(Index member, State& state) const;  // the state before the step until `accept`

  // From t to t + h. The result counts from `accept` on; until then it may be mended, member by member, with `mend`.
  void step(double t, double h, PanelReport& report);
  void mend(const State& state, Index member);
  void accept();

  void energy(std::array<EnergyReading, panel_members>& readings);

 protected:
  // next = Λ(Hamiltonian substep of s), with Λ a factor for every row: a half-flow on the way. Members with numbers
  // that are not finite are in trouble.
  virtual void advance(PanelState& s, const PanelStep& maps, RowFactors after, PanelState& next,
                       PanelReport& report) = 0;
  // A half-flow with what the closure carries beside z; where `damps_z_only`, that is nothing.
  virtual void damp(PanelState& s, double t, double h) { flow(s, t, h); }
  virtual bool damps_z_only() const { return true; }
  virtual void modified_energy(const PanelState&, const PanelValues&, std::array<EnergyReading, panel_members>&) {}

  PanelSystem& system() { return *system_; }
  const PanelSystem& system() const { return *system_; }
  void flow(PanelState& s, double t, double h);                    // z ← Ψ(t, t + h)z, half of the step h of `step`
  const PanelValues& twice_quadratic_energy(const PanelState& s);  // zᵀMz at the start of the substep
  // ẑ, on the support, into `values`; and behind the force, ĝ of the step.
  void predict(PanelState& s, const PanelStep& maps);
  void keep_gradient(PanelState& s) { predictor_.keep(gradient_of(s), step_size_); }
  double* gradient_of(PanelState& s) { return s.z.row(system_->size()); }
  double* values() { return values_.row(0); }  // of V's fields on the grid
  double* slopes() { return slopes_.row(0); }  // likewise
  void potential_of(const PanelState& s, PanelValues& v, PanelValues& magnitude);

 private:
  std::unique_ptr<PanelSystem> system_;
  PanelPredictor predictor_;
  // Factors for every row, one set for each half-flow.
  struct Decay {
    std::vector<PanelValues> of_field;
    std::vector<const double*> of_row;
    double h = -1.0;
  };
  RowFactors factors(Decay& decay, double t, double h);
  void load_values(const State& state, Index member);
  void apply_flow(const BlockMap& flow, PanelState& s);
  void set_rows(Decay& decay);

  bool splits_damping_;
  double step_size_ = 0.0;
  Decay none_, before_, after_;
  PanelValues quadratic_{};
  bool is_measured_ = false;  // quadratic_ is that of the substep
  PanelState first_, second_, work_;
  PanelState* state_ = &first_;  // before the step
  PanelState* next_ = &second_;  // after it
  Panel values_, slopes_, moved_;
};

// Null where the method is not written for panels, or the members do not allow it (PanelSystem::make).
std::unique_ptr<PanelStepper> make_panel_stepper(PanelSimulations members, const MethodOptions& options);

}  // namespace seiche
