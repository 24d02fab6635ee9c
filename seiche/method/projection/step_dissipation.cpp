#include <seiche/method/projection/step_dissipation.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace seiche {

PhiRows StepOutput::at(const Eigen::VectorXd& thetas, PhiRows::Outputs outputs) const {
  PhiRows rows{.rows = {}, .forces = forces, .order = order, .kind = kind, .outputs = outputs};
  for (const double theta : thetas) rows.rows.push_back({theta, weights(theta)});
  return rows;
}

StepDissipation::Kind StepDissipation::kind_of(const System& system, const PhiEvaluator& phi) {
  const bool changes_with_z = system.structure && system.structure->dissipates();
  if (!system.damping->is_constant() || system.force || changes_with_z) return Kind::general;
  const PhiEvaluator::Dissipation d = phi.dissipation();
  if (d.is_zero) return Kind::none;
  return d.is_quadratic && d.is_nonnegative ? Kind::quadratic : Kind::general;
}

// Without damping S is all that dissipates.
bool StepDissipation::energies_tell(const System& system, const PhiEvaluator& phi) {
  return kind_of(system, phi) == Kind::general && !(system.structure && system.structure->dissipates()) &&
         !system.force && system.damping->factor_of_identity(0) && system.potential->homogeneity() > 0 &&
         system.make_undamped_phi()->dissipation().is_zero;
}

StepDissipation::StepDissipation(const System& system, const PhiEvaluator& phi, StepOutput output, StepOutput coarse,
                                 Rules rules)
    : system_(system),
      phi_(phi),
      output_(std::move(output)),
      coarse_output_(std::move(coarse)),
      rules_(std::move(rules)),
      kind_(kind_of(system, phi)),
      needs_gradient_(!phi.dissipation().is_quadratic || system.damping->touches_potential() ||
                      (system.force && system.force->touches_potential())),
      follows_energies_(energies_tell(system, phi)),
      cache_(cached_step_sizes(system.space->size_of_all())) {
  if (!needs_gradient_) coarse_output_ = output_;  // errors of z inside a step oscillate, and their sum is small
  if (kind_ == Kind::none) return;
  const Index size = system.space->size();
  Eigen::VectorXd nodes = rules_.fine.nodes, weights = rules_.fine.weights;
  if (follows_energies_) {
    nodes.resize(rules_.nested.fine.size());
    nodes << 0, 1, rules_.nested.coarse.nodes, rules_.nested.more;
    weights = rules_.nested.fine;
  }
  flow_ = std::make_unique<FlowQuadrature>(system, phi, output_.kind, std::move(nodes), std::move(weights));
  at_end_ = output_.weights(1.0);
  start_.setZero(size);
  gradient_.setZero(size);
  if (kind_ != Kind::general) return;
  between_.resize(rules_.nested.coarse.nodes.size() + rules_.nested.more.size());
  between_ << rules_.nested.coarse.nodes, rules_.nested.more;
  energies_.resize(static_cast<std::size_t>(between_.size()));
  node_.assign(1, Vector::Zero(size));
  for (Vector* v : {&scratch_, &gradient_H_}) v->setZero(size);
}

StepDissipation::Tables& StepDissipation::tables(double h) {
  return cache_.at(h, [&] {
    auto made = std::make_unique<Tables>();
    if (kind_ != Kind::quadratic) return made;
    const auto form = [&](const StepOutput& output, const GaussRule& rule) {
      PhiEvaluator::Form f{output.at(rule.nodes, PhiRows::Outputs::all), {}};
      for (const double w : rule.weights) f.coefficients.push_back(h * w);
      return f;
    };
    const std::array forms = {form(output_, rules_.fine), form(coarse_output_, rules_.coarse)};
    made->forms = phi_.forms(forms, h);
    return made;
  });
}

void StepDissipation::Sum::add(double weight, const System::Dissipation& q) {
  taken += weight * q.rate;
  work += weight * q.work;
  if (!(q.rate < -q.round_off)) return;
  negative = true;
  gain -= weight * q.rate;
}

void StepDissipation::add(double t, const Vector& z, const Vector& gradient, double weight, Sum& sum) {
  sum.add(weight, system_.dissipation(t, z, gradient, scratch_, gradient_H_));
}

void StepDissipation::add_nodes(double t, double h, const Vector& z, std::span<const Vector> forces,
                                const StepOutput& output, const GaussRule& rule, NodeMaps& maps, Sum& sum) {
  if (maps.empty())
    for (const double theta : rule.nodes)
      maps.push_back(phi_.map(output.at(Eigen::VectorXd::Constant(1, theta), PhiRows::Outputs::all), h));
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const auto at = static_cast<Index>(i);
    maps[i]->apply(z, forces, {node_.data(), 1});
    if (needs_gradient_) system_.potential->gradient(node_[0], gradient_);
    add(t + rule.nodes[at] * h, node_[0], gradient_, h * rule.weights[at], sum);
  }
}

//   D = h Σ w_i Q(Z(θ_i)) by the finer rule, u = |D − D'| with D' by the coarser one                             (E3)
StepDissipation::Amount StepDissipation::measure(double t, double h, const Vector& z, std::span<const Vector> forces,
                                                 const Sum* coarse) {
  Amount amount;
  switch (kind_) {
    case Kind::none: break;
    case Kind::quadratic: {
      std::array<double, 2> values{};
      tables(h).forms->apply(z, forces, values);
      amount.fine = values[0];
      amount.doubt = std::abs(values[0] - values[1]);
      break;
    }
    case Kind::general: {
      Sum by_coarse, by_fine;
      if (coarse != nullptr)
        by_coarse = *coarse;
      else
        add_nodes(t, h, z, forces, coarse_output_, rules_.coarse, tables(h).coarse, by_coarse);
      add_nodes(t, h, z, forces, output_, rules_.fine, tables(h).fine, by_fine);
      amount = {.fine = by_fine.taken,
                .doubt = std::abs(by_fine.taken - by_coarse.taken),
                .work = by_fine.work,
                .negative = by_coarse.negative || by_fine.negative,
                .gain = std::max(by_coarse.gain, by_fine.gain)};
      break;
    }
  }
  return amount;
}

void StepDissipation::prepare_flow(double h) {
  if (flow_) flow_->prepare(h);
}

// The polynomial through the forces takes the value Σ_j C_0j n_j at θ = 0, and weights(1) begins with C_0j for each
// force.
double StepDissipation::flow_missed(double h, const State& s, std::span<const Vector> forces) {
  if (!flow_ || flow_->resolves(h)) return 0;
  const bool gradients = output_.kind == PhiRows::Forces::gradients;
  const Potential::Support of = gradients ? system_.potential->support() : Potential::Support{0, s.z.size()};
  auto start = start_.segment(of.begin, of.size);
  start = at_end_[0] * forces[0].segment(of.begin, of.size);
  for (std::size_t j = 1; j < forces.size(); ++j)
    start += at_end_[j * static_cast<std::size_t>(output_.order)] * forces[j].segment(of.begin, of.size);
  return flow_->miss(h, s.z, start_, s.energy_terms);
}

StepDissipation::Energies StepDissipation::energies(const System& system, const Vector& z, double H) {
  const double K = system.linear->quadratic_energy(z);
  return {K, H - K};
}

System::Dissipation StepDissipation::of_energies(const System& system, double t, const Energies& e) {
  const double gamma = *system.damping->factor_of_identity(t);
  const double degree = system.potential->homogeneity();
  return {.rate = gamma * (2 * e.K + degree * e.V),
          .round_off = 100 * epsilon * std::abs(gamma) * (2 * std::abs(e.K) + degree * std::abs(e.V))};
}

StepDissipation::Amount StepDissipation::measure(double t, double h, const Vector& z, std::span<const Vector> forces,
                                                 const Energies& before, const Energies& after,
                                                 std::span<const Energies> at_nodes) {
  const NestedRules& rules = rules_.nested;
  std::copy(at_nodes.begin(), at_nodes.end(), energies_.begin());
  if (const std::size_t asked = energies_.size() - at_nodes.size(); asked > 0) {
    Tables& of_h = tables(h);
    if (!of_h.between)
      of_h.between = phi_.map(output_.at(between_.tail(static_cast<Index>(asked)), PhiRows::Outputs::all), h);
    if (node_.size() < asked) node_.resize(asked, Vector::Zero(z.size()));
    of_h.between->apply(z, forces, {node_.data(), asked});
    for (std::size_t i = 0; i < asked; ++i)
      energies_[at_nodes.size() + i] = {system_.linear->quadratic_energy(node_[i]), system_.potential->value(node_[i])};
  }

  Amount amount;
  double coarse = 0;
  const auto rate = [&](double theta, const Energies& e) {
    const System::Dissipation q = of_energies(system_, t + theta * h, e);
    amount.negative = amount.negative || q.rate < -q.round_off;
    return h * q.rate;
  };
  amount.fine = rules.fine[0] * rate(0, before) + rules.fine[1] * rate(1, after);
  for (Index i = 0; i < between_.size(); ++i) {
    const double taken = rate(between_[i], energies_[static_cast<std::size_t>(i)]);
    amount.fine += rules.fine[2 + i] * taken;
    if (i < rules.coarse.nodes.size()) coarse += rules.coarse.weights[i] * taken;
  }
  amount.doubt = std::abs(amount.fine - coarse);
  return amount;
}

}  // namespace seiche
