#include <seiche/method/projection/flow_quadrature.hpp>

#include <cmath>

namespace seiche {

FlowQuadrature::FlowQuadrature(const System& system, const PhiEvaluator& phi, PhiRows::Forces kind,
                               Eigen::VectorXd nodes, Eigen::VectorXd weights)
    : phi_(phi),
      kind_(kind),
      nodes_(std::move(nodes)),
      weights_(std::move(weights)),
      cache_(cached_step_sizes(system.space->size_of_all())) {}

const PhiForms& FlowQuadrature::error(double h) {
  return cache_.at(h, [&] {
    PhiEvaluator::Form form{.rows = {.rows = {}, .forces = 1, .order = 1, .kind = kind_},
                            .coefficients = {},
                            .minus_integral = true};
    for (Index i = 0; i < nodes_.size(); ++i) {
      form.rows.rows.push_back({nodes_[i], {nodes_[i]}});
      form.coefficients.push_back(h * weights_[i]);
    }
    return phi_.forms({&form, 1}, h);
  });
}

double FlowQuadrature::miss(double h, const Vector& z, const Vector& n, double terms) {
  double missed = 0;
  error(h).apply(z, {&n, 1}, {&missed, 1});
  return std::abs(missed) <= 16 * epsilon * terms ? 0.0 : missed;
}

}  // namespace seiche
