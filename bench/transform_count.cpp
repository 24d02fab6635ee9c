#include "transform_count.hpp"

#include <seiche/core/base/error.hpp>
#include <seiche/simulation/simulation.hpp>

namespace seiche::bench {
namespace {

// Counts points instead of calls, since a transform may hand over its values block by block.
class CountingPotential final : public PointwisePotential {
 public:
  CountingPotential(std::shared_ptr<const PointwisePotential> inner, double& points)
      : inner_(std::move(inner)), points_(points) {}

  Index fields() const override { return inner_->fields(); }
  bool is_local() const override { return inner_->is_local(); }
  double value(std::span<const double> u) const override {
    count(u, there);
    return inner_->value(u);
  }
  ValueAndMagnitude value_and_magnitude(std::span<const double> u) const override {
    count(u, there);
    return inner_->value_and_magnitude(u);
  }
  double value_and_gradient(std::span<const double> u, std::span<double> gradient) const override {
    count(u, there + back);
    return inner_->value_and_gradient(u, gradient);
  }
  double value_and_gradient_in_place(double in, double out, std::span<double> values) const override {
    count(values, there + back);
    return inner_->value_and_gradient_in_place(in, out, values);
  }
  void mean_gradient(std::span<const double> a, std::span<const double> b, std::span<double> mean) const override {
    count(a, 2 * there + back);
    inner_->mean_gradient(a, b, mean);
  }
  int degree() const override { return inner_->degree(); }
  int homogeneity() const override { return inner_->homogeneity(); }
  void along(std::span<const double> p, std::span<const double> q, std::span<double> coefficients) const override {
    count(p, 2 * there);
    inner_->along(p, q, coefficients);
  }
  bool grows_outward() const override { return inner_->grows_outward(); }

 private:
  static constexpr double there = 1, back = 1;
  void count(std::span<const double> u, double transforms) const {
    points_ += transforms * static_cast<double>(u.size());
  }

  std::shared_ptr<const PointwisePotential> inner_;
  double& points_;
};

}  // namespace

double transforms_per_step(const Problem& problem, const std::string& method, double h) {
  constexpr int steps = 4;
  double points = 0;
  Problem counted = problem;
  counted.potential = std::make_shared<CountingPotential>(problem.potential, points);
  Simulation simulation(counted, {.method = method, .backend = "modal"});
  for (int n = 0; n <= MidpointMemory::depth; ++n) simulation.step(h);
  points = 0;  // what it took to begin
  for (int n = 0; n < steps; ++n)
    if (!simulation.step(h).solved()) throw Error("a step of {} failed", method);
  return points / (steps * static_cast<double>(problem.potential->fields() * problem.grid.unknowns()));
}

}  // namespace seiche::bench
