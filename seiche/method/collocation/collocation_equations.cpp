#include <seiche/method/collocation/collocation_equations.hpp>
#include <seiche/method/collocation/force_sums.hpp>
#include <seiche/method/collocation/sweep_control.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {

CollocationEquations::CollocationEquations(const System& system, const GaussRule& rule, Kept kept, bool has_tables)
    : system_(system),
      rule_(rule),
      force_(system),
      of_forces_(force_.kind() == PhiRows::Forces::gradients ? system.potential->support()
                                                             : Potential::Support{0, system.space->size()}),
      has_tables_(has_tables),
      forces_(static_cast<std::size_t>(rule.nodes.size()), Vector::Zero(system.space->size())),
      components_before_(of_forces_.size),
      change_(Vector::Zero(system.space->size())),
      rate_(change_) {
  if (kept == Kept::energies) energies_.resize(forces_.size());
  if (kept == Kept::samples) samples_.assign(forces_.size(), {change_, change_});
  if (is_gradient_flow(system)) {
    const bool all = outputs() == PhiRows::Outputs::all;
    acceleration_.emplace(*system.space, forces_.size(), all ? Potential::Support{0, change_.size()} : of_forces_,
                          memory);
  }
}

PhiRows::Outputs CollocationEquations::outputs() const {
  return kind() == PhiRows::Forces::states || !samples_.empty() ? PhiRows::Outputs::all : PhiRows::Outputs::support;
}

double CollocationEquations::predict(const State& s, double t, double h) {
  if (s.history_h == 0) {
    forces_[0] = s.z;
    force_.evaluate(t, forces_[0]);
    for (std::size_t i = 1; i < forces_.size(); ++i) forces_[i] = forces_[0];
    return system_.space->norm(forces_[0].segment(of_forces_.begin, of_forces_.size));
  }
  const double ratio = h / s.history_h;
  const Eigen::MatrixXd& extrapolation = extrapolations_.at(ratio, [&] {
    return std::make_unique<Eigen::MatrixXd>(
        evaluation(rule_.nodes, Eigen::VectorXd::Ones(stages()) + ratio * rule_.nodes));
  });
  return combine(*system_.space, extrapolation, s.history, of_forces_.begin, of_forces_.size, forces_);
}

void CollocationEquations::evaluate(double t, double h, bool keeps) {
  for (Index i = 0; i < stages(); ++i) {
    const double at = t + rule_.nodes[i] * h;
    const auto which = static_cast<std::size_t>(i);
    if (!energies_.empty() && keeps) {
      energies_[which].K = system_.linear->quadratic_energy(forces_[which]);
      energies_[which].V = force_.evaluate(at, forces_[which]);
    } else if (!samples_.empty() && keeps) {
      force_.evaluate(at, forces_[which], [&](const Vector& node, const Vector& gradient) {
        samples_[which].node = node;
        samples_[which].gradient = gradient;
      });
    } else {
      force_.evaluate(at, forces_[which]);
    }
  }
}

bool CollocationEquations::solve(const State& s, double t, double h, const PhiMap& nodes, FunctionRef<double()> error) {
  return acceleration_ ? sweep_accelerated(s, t, h, nodes, error) : sweep(s, t, h, nodes, error);
}

// The force at the last node, which follows from all the others, stands for what a sweep changes.
bool CollocationEquations::sweep(const State& s, double t, double h, const PhiMap& nodes, FunctionRef<double()> error) {
  SweepControl control(stages(), s.history_h != 0, has_tables_);
  double change = 0, change_before = 0;
  do {
    components_before_ = forces_.back().segment(of_forces_.begin, of_forces_.size);
    nodes.apply(s.z, forces_, forces_);  // Z_i: (E1)
    evaluate(t, h, control.may_be_last());
    change_before = change;
    change = h * distance(*system_.space, forces_.back(), of_forces_.begin, components_before_);
  } while (control.wants_another(change, error));
  convergence_ = change_before > 0 ? std::min(1.0, change / change_before) : 0;  // one sweep tells no rate
  return true;
}

// The unknowns are the Z_i: of F_i what L damps would count for most.
bool CollocationEquations::sweep_accelerated(const State& s, double t, double h, const PhiMap& nodes,
                                             FunctionRef<double()> error) {
  constexpr int least = 3, most = 20;  // two of them tell no rate
  constexpr double small = 0.1;        // beside the error of the step, which counts for less: it is not of slow modes
  constexpr double of_first = 1e-3;    // where nothing tells that error
  constexpr double far = 1e-3;         // from a solution, as a share of its size
  const double of_one = 1 / std::sqrt(static_cast<double>(stages()));
  const double size_before = system_.space->norm(s.z);
  const bool knows_error = has_tables_ && s.history_h != 0;
  double first = 0, left = 0, size = 0;
  acceleration_->restart();
  for (int sweeps = 1; sweeps <= most; ++sweeps) {
    const double before = acceleration_->residual();
    nodes.apply(s.z, forces_, forces_);  // Z_i: (E1)
    acceleration_->advance(forces_);
    evaluate(t, h, sweeps >= least);
    const double residual = acceleration_->residual();
    if (sweeps == 2) first = residual;
    if (sweeps < least) continue;
    if (!std::isfinite(residual)) return false;
    convergence_ = residual < before ? residual / before : 1;
    left = of_one * convergence_ * acceleration_->least_residual();
    size = std::max(size_before, of_one * acceleration_->size());
    if (left <= epsilon * size) return true;
    if (left <= far * size && left <= (knows_error ? small * error() : of_first * of_one * first)) return true;
  }
  return left <= far * size;
}

const Vector& CollocationEquations::unsolved(double h, const Vector& last) {
  change_.setZero();
  if (acceleration_) {
    acceleration_->least_residual(change_);
    change_ *= convergence_;
    return change_;
  }
  constexpr double calibration = 1.0 / 16;  // the force at the last node changes most
  change_.segment(of_forces_.begin, of_forces_.size) =
      calibration * h * convergence_ * (last.segment(of_forces_.begin, of_forces_.size) - components_before_);
  apply_S(change_);
  return change_;
}

void CollocationEquations::apply_S(Vector& f) {
  if (kind() == PhiRows::Forces::states) return;
  const Index behind = of_forces_.begin + of_forces_.size;
  f.head(of_forces_.begin).setZero();
  f.tail(f.size() - behind).setZero();
  system_.linear->apply_S(f, rate_);
  f.swap(rate_);
}

}  // namespace seiche
