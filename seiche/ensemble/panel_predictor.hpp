// ẑ of all members of a panel: method/closure/midpoint_predictor.hpp side by side.
#pragma once

#include <seiche/core/base/function_ref.hpp>
#include <seiche/core/state.hpp>
#include <seiche/ensemble/panel_system.hpp>
#include <seiche/method/methods.hpp>

#include <array>

namespace seiche {

class PanelPredictor {
 public:
  PanelPredictor(const PanelSystem& system, Predictor kind);  // which outlives it

  // ẑ of a step h, on the support. `z` is followed by the rows of `g`, which is written over: with the remembered ḡ,
  // and with ∇V(z) by `take_gradient` where a member needs that.
  void predict(const double* z, double* g, const PanelStep& maps, double h, double* z_mid,
               FunctionRef<void()> take_gradient);
  // ĝ of the step, which counts from `accept` on.
  void keep(const double* g, double h);
  void accept();

  void load(const State& state, Index member);
  void store(Index member, State& state) const;
  void mend(const State& state, Index member);  // the state behind the step, instead of what was kept

 private:
  // Members that are to take ∇V(z): mask ≠ 0.
  void find_unable(double weight);
  void find_missed(const double* z, const double* z_mid, const PanelStep& maps, const PanelValues& second_difference);
  PanelValues measure_missed(const PanelStep& maps);  // |Qd|² of each member
  bool any_unable() const;

  const PanelSystem& system_;
  bool remembers_;
  std::array<Panel, MidpointMemory::depth> gradients_;  // the newest first
  std::array<double, MidpointMemory::depth> lengths_{};
  Panel kept_, difference_, by_gradient_;                            // difference_: (0, d), its rows of z are zero
  PanelValues known_{}, resting_{}, kept_known_{}, kept_resting_{};  // whole numbers
  PanelValues unable_{}, has_missed_{};
  double kept_length_ = 0;
};

}  // namespace seiche
