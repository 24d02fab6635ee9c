// V(u) = Σ_j W(u_{j+1} − u_j) for many states at once.
#pragma once

#include <seiche/core/grid/grid.hpp>
#include <seiche/potential/panel_loops.hpp>

#include <vector>

namespace seiche {

// Bonds of a chain of `rows` points: as many on a ring, one more between ends where u = 0, one less between free ends.
Index bond_count(Index rows, Boundary boundary);

// The stretch of every bond, bonds × members, from left to right. On a ring the first one ends at point 0.
void panel_stretches(const double* u, Index rows, Boundary boundary, double* stretch);

// What bonds of these tensions do to the points at their ends.
void panel_pull(const double* tension, Index rows, Boundary boundary, double* gradient);

template <PointPotential W>
class BondPanel final : public PanelPotential {
 public:
  BondPanel(const std::vector<W>& w, Index rows, Boundary boundary)
      : w_(w),
        rows_(rows),
        bonds_(bond_count(rows, boundary)),
        boundary_(boundary),
        a_(bonds_),
        b_(bonds_),
        tension_(bonds_) {}

  void gradient(const double* u, double* gradient) const override {
    panel_stretches(u, rows_, boundary_, a_.row(0));
    w_.slopes(a_.row(0), tension_.row(0), bonds_);
    panel_pull(tension_.row(0), rows_, boundary_, gradient);
  }
  void value_and_gradient(const double* u, double* gradient, PanelValues& values) const override {
    panel_stretches(u, rows_, boundary_, a_.row(0));
    w_.values_and_slopes(a_.row(0), tension_.row(0), bonds_, values);
    panel_pull(tension_.row(0), rows_, boundary_, gradient);
  }
  void value_and_magnitude(const double* u, PanelValues& values, PanelValues& magnitudes) const override {
    panel_stretches(u, rows_, boundary_, a_.row(0));
    w_.values_and_magnitudes(a_.row(0), bonds_, values, magnitudes);
  }
  void mean_gradient(const double* a, const double* b, double* mean) const override {
    panel_stretches(a, rows_, boundary_, a_.row(0));
    panel_stretches(b, rows_, boundary_, b_.row(0));
    w_.mean_slopes(a_.row(0), b_.row(0), tension_.row(0), bonds_);
    panel_pull(tension_.row(0), rows_, boundary_, mean);
  }

 private:
  PanelW<W> w_;
  Index rows_, bonds_;
  Boundary boundary_;
  mutable Panel a_, b_, tension_;  // scratch
};

}  // namespace seiche
