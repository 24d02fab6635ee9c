#include <seiche/method/step_dissipation.hpp>

#include <array>
#include <utility>

namespace seiche {

PhiRows DenseOutput::at(const Eigen::VectorXd& thetas, PhiRows::Outputs outputs) const {
  PhiRows rows{.rows = {}, .forces = forces, .order = order, .kind = kind, .outputs = outputs};
  for (const double theta : thetas) rows.rows.push_back({theta, weights(theta)});
  return rows;
}

StepDissipation::Kind StepDissipation::kind_of(const System& system, const PhiEvaluator& phi) {
  if (!system.damping->is_frozen() || system.force) return Kind::general;
  const PhiEvaluator::Dissipation d = phi.dissipation();
  if (d.is_zero) return Kind::none;
  return d.is_quadratic && d.is_nonnegative ? Kind::quadratic : Kind::general;
}

StepDissipation::StepDissipation(const System& system, const PhiEvaluator& phi, DenseOutput output, GaussRule coarse,
                                 GaussRule fine)
    : system_(system),
      phi_(phi),
      output_(std::move(output)),
      coarse_(std::move(coarse)),
      fine_(std::move(fine)),
      kind_(kind_of(system, phi)),
      needs_gradient_(!phi.dissipation().is_quadratic || system.damping->touches_potential() ||
                      (system.force && system.force->touches_potential())),
      cache_(cached_step_sizes(system.space->size())) {
  if (kind_ != Kind::general) return;
  const Index size = system.space->size();
  node_.assign(1, Vector::Zero(size));
  for (Vector* v : {&gradient_, &scratch_, &gradient_H_}) v->setZero(size);
}

StepDissipation::Tables& StepDissipation::tables(double h) {
  return cache_.at(h, [&] {
    auto made = std::make_unique<Tables>();
    if (kind_ != Kind::quadratic) return made;
    const auto form = [&](const GaussRule& rule) {
      PhiEvaluator::Form f{output_.at(rule.nodes, PhiRows::Outputs::all), {}};
      for (const double w : rule.weights) f.coefficients.push_back(h * w);
      return f;
    };
    const std::array forms = {form(fine_), form(coarse_)};
    made->forms = phi_.forms(forms, h);
    return made;
  });
}

void StepDissipation::add(double t, const Vector& z, const Vector& gradient, double weight, Sum& sum) {
  const System::Dissipation q = system_.dissipation(t, z, gradient, scratch_, gradient_H_);
  sum.taken += weight * q.rate;
  sum.work += weight * q.work;
  sum.negative = sum.negative || q.rate < -q.round_off;
}

void StepDissipation::add_nodes(double t, double h, const Vector& z, std::span<const Vector> forces,
                                const GaussRule& rule, NodeMaps& maps, Sum& sum) {
  if (maps.empty())
    for (const double theta : rule.nodes)
      maps.push_back(phi_.map(output_.at(Eigen::VectorXd::Constant(1, theta), PhiRows::Outputs::all), h));
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const auto at = static_cast<Index>(i);
    maps[i]->apply(z, forces, node_);
    if (needs_gradient_) system_.potential->gradient(node_[0], gradient_);
    add(t + rule.nodes[at] * h, node_[0], gradient_, h * rule.weights[at], sum);
  }
}

StepDissipation::Amount StepDissipation::measure(double t, double h, const Vector& z, std::span<const Vector> forces,
                                                 const Sum* coarse) {
  Amount amount;
  switch (kind_) {
    case Kind::none: break;
    case Kind::quadratic: {
      std::array<double, 2> values{};
      tables(h).forms->apply(z, forces, values);
      amount.fine = values[0];
      amount.coarse = values[1];
      break;
    }
    case Kind::general: {
      Sum by_coarse, by_fine;
      if (coarse != nullptr)
        by_coarse = *coarse;
      else
        add_nodes(t, h, z, forces, coarse_, tables(h).coarse, by_coarse);
      add_nodes(t, h, z, forces, fine_, tables(h).fine, by_fine);
      amount = {.fine = by_fine.taken,
                .coarse = by_coarse.taken,
                .work = by_fine.work,
                .negative = by_coarse.negative || by_fine.negative};
      break;
    }
  }
  return amount;
}

}  // namespace seiche
