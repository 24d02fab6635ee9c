// The equation of up to sixteen members as maps on panels.
#pragma once

#include <seiche/core/panel_potential.hpp>
#include <seiche/ensemble/block_map.hpp>
#include <seiche/ensemble/folded_transform.hpp>
#include <seiche/simulation/simulation.hpp>

#include <memory>
#include <span>
#include <vector>

namespace seiche {

using PanelSimulations = std::span<const Simulation* const>;  // one for every column of a panel, some of them the same

// xᵀAx for all members; quick where A is diagonal.
class PanelQuadratic {
 public:
  PanelQuadratic() = default;
  explicit PanelQuadratic(std::span<const Eigen::MatrixXd> matrices);
  const double* diagonal() const { return diagonal_.rows() > 0 ? diagonal_.row(0) : nullptr; }  // null: not diagonal
  void operator()(const double* x, PanelValues& sum) const;

 private:
  Index rows_ = 0;
  Panel diagonal_;  // one row for each of A's
  BlockMap map_;
};

// The maps of one step size. A panel that holds z and, below it, a gradient on the support of V is called (z, g).
struct PanelStep {
  BlockMap predict;            // (z, ∇V(z)) → ẑ, on the support
  PanelValues gradient_share;  // of each member ≥ |Qg|²/|g|², with Q the part of `predict` that multiplies g
  BlockMap increment;          // z → FMz, on the support
  PanelQuadratic force;        // g → gᵀFg
  BlockMap step;               // (z, g) → FMz + Fg
  BlockMap all_forces;         // g → Fg
  // The constant part of a half-flow, e^{−hD/2}; e^{−hD/4}, to be applied twice, where the rates do not commute with
  // it. No rows without a constant part.
  BlockMap flow;
};

// Everything is read off the backend's own operators, applied to unit vectors: members step by the same numbers as an
// ordinary run, and every backend with fields one after the other can be used. Rows are the coordinates of State::z
// without those that are always zero.
class PanelSystem {
 public:
  // Null where the members have different shapes, the coordinates of the backend are not one orthonormal transform per
  // field, or the damping changes from point to point.
  static std::unique_ptr<PanelSystem> make(PanelSimulations members, PropagatorKind kind);

  Index size() const { return static_cast<Index>(place_.size()); }  // rows of z
  Index support_begin() const { return support_begin_; }
  Index support_size() const { return support_size_; }
  Index field_size() const { return field_size_; }
  PanelPotential& potential() const { return *potential_; }
  const PanelQuadratic& metric() const { return metric_; }
  const PanelQuadratic& absolute_metric() const { return absolute_metric_; }
  bool damping_moves_potential() const { return damping_moves_potential_; }
  const PanelStep& at(double h);  // built when first asked for

  // Values of V's fields from the coordinates of its support, and back; the second destroys its input.
  void to_values(const double* support, double* values) const;
  void to_coordinates(double* values, double* support) const;

  void load(const Vector& z, Index member, Panel& panel) const;
  void store(const Panel& panel, Index member, Vector& z) const;
  // The same of the support alone, for panels that hold nothing else.
  void load_support(const Vector& z, Index member, Panel& panel) const;
  void store_support(const Panel& panel, Index member, Vector& z) const;

  // The factors by which γ(t) multiplies each field over [t, t + h], one for every member.
  void decay(double t, double h, std::vector<PanelValues>& factors) const;
  bool rates_commute() const { return rates_commute_; }            // with the constant part of the damping
  bool has_constant_rates() const { return has_constant_rates_; }  // then they depend on h alone
  Index fields() const { return fields_; }

 private:
  PanelSystem(PanelSimulations members, PropagatorKind kind);
  bool find_transform();
  void find_metrics();
  PanelStep make_step(double h) const;

  std::vector<const Simulation*> columns_;  // one for every column
  std::vector<const Simulation*> members_;  // those that differ: all of them, or one
  PropagatorKind kind_;
  std::vector<Index> place_;  // of every row in State::z
  Index fields_ = 1, field_size_ = 0, support_begin_ = 0, support_size_ = 0;
  FoldedTransform transform_;  // of one field
  std::unique_ptr<PanelPotential> potential_;
  PanelQuadratic metric_, absolute_metric_;
  bool damping_moves_potential_ = false, has_constant_damping_ = false, has_constant_rates_ = true;
  bool rates_commute_ = true;
  std::vector<std::pair<double, PanelStep>> steps_;
};

}  // namespace seiche
