#include <seiche/core/numerics/gauss_rule.hpp>
#include <seiche/core/numerics/quadrature.hpp>

#include <cmath>

namespace seiche {
namespace {

// Extended precision: the Vandermonde matrices of four nodes lose two digits.
using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

LongMatrix powers(const Eigen::VectorXd& points, Eigen::Index count) {
  LongMatrix v(points.size(), count);
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    long double power = 1;
    for (Eigen::Index k = 0; k < count; ++k, power *= points[i]) v(i, k) = power;
  }
  return v;
}

LongMatrix inverse_of_powers(const Eigen::VectorXd& nodes) { return powers(nodes, nodes.size()).fullPivLu().inverse(); }

}  // namespace

GaussRule::GaussRule(int s) : nodes(s), weights(s) {
  Eigen::Index i = 0;
  for (const GaussNode& node : gauss_rule(s)) {
    nodes[i] = node.place;
    weights[i++] = node.weight;
  }
}

NestedRules::NestedRules(int s) : coarse(s), more(s - 1) {
  const GaussRule exact(2 * s);  // to degree 4s − 1
  // By symmetry e is y, y² − a or y(y² − a), with y = θ − ½.
  if (s > 2) {
    double above = 0, below = 0;
    for (Eigen::Index i = 0; i < exact.nodes.size(); ++i) {
      const double theta = exact.nodes[i];
      const double y = theta - 0.5;
      const double factor = exact.weights[i] * (theta - coarse.nodes.array()).prod() * theta * (theta - 1);
      above += factor * std::pow(y, s);
      below += factor * std::pow(y, s - 2);
    }
    const double root = std::sqrt(above / below);
    more[0] = 0.5 - root;
    more[s - 2] = 0.5 + root;
  }
  if (s % 2 == 0) more[(s - 2) / 2] = 0.5;
  Eigen::VectorXd nodes(2 * s + 1);
  nodes << 0, 1, coarse.nodes, more;
  fine = evaluation(nodes, exact.nodes).transpose() * exact.weights;
}

Eigen::MatrixXd interpolation(const Eigen::VectorXd& nodes) { return inverse_of_powers(nodes).cast<double>(); }

Eigen::MatrixXd evaluation(const Eigen::VectorXd& nodes, const Eigen::VectorXd& points) {
  return (powers(points, nodes.size()) * inverse_of_powers(nodes)).cast<double>();
}

}  // namespace seiche
