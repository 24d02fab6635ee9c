#include <seiche/core/spectral_radius.hpp>
#include <seiche/method/flow_quadrature.hpp>

#include <cmath>

namespace seiche {

FlowQuadrature::FlowQuadrature(const System& system, const PhiEvaluator& phi, Eigen::VectorXd nodes,
                               Eigen::VectorXd weights)
    : system_(system),
      phi_(phi),
      nodes_(std::move(nodes)),
      weights_(std::move(weights)),
      cache_(cached_step_sizes(system.space->size())),
      inputs_(2, Vector::Zero(system.space->size())),
      x_(Vector::Zero(system.space->size())),
      Mx_(x_) {}

FlowQuadrature::Tables FlowQuadrature::make_tables(double h) const {
  constexpr auto states = PhiRows::Forces::states;
  PhiEvaluator::Form form{{.rows = {}, .forces = 1, .order = 1, .kind = states}, {}};
  for (Eigen::Index i = 0; i < nodes_.size(); ++i) {
    form.rows.rows.push_back({nodes_[i], {nodes_[i]}});
    form.coefficients.push_back(h * weights_[i]);
  }
  Tables made;
  made.quadrature = phi_.forms({&form, 1}, h);
  made.end = phi_.map({.rows = {{1.0, {1.0}}}, .forces = 1, .order = 1, .kind = states}, h);
  // ∫₀ʰ x dt = hφ₁(hL)z + h²φ₂(hL)n
  made.integral =
      phi_.map({.rows = {{1.0, {1.0, 0.0, 0.0, h}}}, .forces = 2, .order = 2, .kind = states, .of_state = false}, h);
  return made;
}

bool FlowQuadrature::resolves(double h) {
  constexpr double by_iteration = 1.5;  // power iteration comes from below
  if (!rate_) rate_ = by_iteration * rate_of_linear_flow(system_);
  return h * *rate_ <= 2;
}

FlowQuadrature::Tables& FlowQuadrature::tables(double h) {
  return cache_.at(h, [&] { return std::make_unique<Tables>(make_tables(h)); });
}

double FlowQuadrature::miss(double h, const Vector& z, const Vector& n) {
  const Tables& of_h = tables(h);
  inputs_[0] = z;
  inputs_[1] = n;
  double quadrature = 0;
  of_h.quadrature->apply(z, {&inputs_[1], 1}, {&quadrature, 1});
  of_h.end->apply(z, {&inputs_[1], 1}, {&x_, 1});
  const double before = system_.linear->quadratic_energy(z);
  const double after = system_.linear->quadratic_energy(x_);
  of_h.integral->apply(z, inputs_, {&x_, 1});
  system_.linear->apply_M(x_, Mx_);
  const double work = n.dot(Mx_);
  const double missed = quadrature - (before - after + work);
  const double round_off = 16 * epsilon * (std::abs(quadrature) + before + after + n.cwiseAbs().dot(Mx_.cwiseAbs()));
  return std::abs(missed) <= round_off ? 0.0 : missed;
}

}  // namespace seiche
