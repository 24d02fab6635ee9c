// V(u) = Σ_j W(u_j) for many states at once.
#pragma once

#include <seiche/potential/panel_loops.hpp>

#include <vector>

namespace seiche {

template <PointPotential W>
class NodalPanel final : public PanelPotential {
 public:
  NodalPanel(const std::vector<W>& w, Index rows) : w_(w), rows_(rows) {}

  void gradient(const double* u, double* gradient) const override { w_.slopes(u, gradient, rows_); }
  void value_and_gradient(const double* u, double* gradient, PanelValues& values) const override {
    w_.values_and_slopes(u, gradient, rows_, values);
  }
  void value_and_magnitude(const double* u, PanelValues& values, PanelValues& magnitudes) const override {
    w_.values_and_magnitudes(u, rows_, values, magnitudes);
  }
  void mean_gradient(const double* a, const double* b, double* mean) const override {
    w_.mean_slopes(a, b, mean, rows_);
  }

 private:
  PanelW<W> w_;
  Index rows_;
};

}  // namespace seiche
