#include <seiche/core/numerics/gauss_rule.hpp>
#include <seiche/petsc/joint_potential.hpp>
#include <seiche/potential/own_potential.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace seiche {
namespace {

class JointPotential final : public Potential {
 public:
  JointPotential(std::shared_ptr<const TsFunctions> functions, const Space& space)
      : functions_(std::move(functions)),
        space_(space),
        support_{0, functions_->has_V() ? functions_->support() : 0},
        rule_(gauss_rule(4)) {
    for (Vector* v : {&at_, &slope_, &step_, &sum_}) v->resize(support_.size);
  }

  double value(const Vector& z) const override {
    if (!functions_->has_V()) return 0;
    ++counts_.values;
    return functions_->value(part(z));
  }
  double magnitude(const Vector& z) const override { return value_and_magnitude(z).magnitude; }
  ValueAndMagnitude value_and_magnitude(const Vector& z) const override {
    if (!functions_->has_V()) return {};
    const double V = value(z);
    functions_->gradient(part(z), span_of(slope_));
    const double terms = space_.sum(z.head(support_.size).cwiseAbs().dot(slope_.cwiseAbs()));
    return {.value = V, .magnitude = std::abs(V) + terms};
  }
  double value_and_gradient(const Vector& z, Vector& gradient) const override {
    if (!functions_->has_V()) return 0;
    ++counts_.gradients;
    const double V = functions_->value(part(z));
    functions_->gradient(part(z), span_of(slope_));
    gradient.head(support_.size) = slope_;
    return V;
  }
  void mean_gradient(const Vector& a, const Vector& b, Vector& mean) const override {
    if (!functions_->has_V()) return;
    ++counts_.gradients;
    step_ = b.head(support_.size) - a.head(support_.size);
    sum_.setZero();
    for (const GaussNode& node : rule_) {
      at_ = a.head(support_.size) + node.place * step_;
      functions_->gradient(span_of(at_), span_of(slope_));
      sum_ += node.weight * slope_;
    }
    const double Va = functions_->value(part(a)), Vb = functions_->value(part(b));
    std::array<double, 3> totals = {sum_.dot(step_), sum_.cwiseAbs().dot(step_.cwiseAbs()), step_.squaredNorm()};
    space_.sum(totals);
    const double defect = (Vb - Va) - totals[0];
    if (std::abs(defect) > 8 * epsilon * (std::abs(Va) + std::abs(Vb) + totals[1]))
      sum_ += (defect / totals[2]) * step_;
    mean.head(support_.size) = sum_;
  }
  int degree() const override { return functions_->has_V() ? 0 : 1; }
  void along(const Vector&, const Vector&, std::span<double> coefficients) const override {
    std::fill(coefficients.begin(), coefficients.end(), 0.0);
  }
  void along_ray(const Vector&, std::span<double> coefficients) const override {
    std::fill(coefficients.begin(), coefficients.end(), 0.0);
  }
  Support support() const override { return support_; }

 private:
  std::span<const double> part(const Vector& z) const { return {z.data(), static_cast<std::size_t>(support_.size)}; }

  std::shared_ptr<const TsFunctions> functions_;
  const Space& space_;
  Support support_;
  std::vector<GaussNode> rule_;
  mutable Vector at_, slope_, step_, sum_;
};

}  // namespace

std::unique_ptr<Potential> joint_potential(std::shared_ptr<const TsFunctions> functions, const Space& space) {
  return std::make_unique<JointPotential>(std::move(functions), space);
}

// V along the directions is a function of as many numbers, which all processes know.
std::string gradient_complaint(const TsFunctions& functions, const Space& space, const Vector& z) {
  if (!functions.has_V()) return "";
  std::array<double, 2> ends = {functions.value(span_of(z).first(static_cast<std::size_t>(functions.support()))), 0};
  ends[1] = -ends[0];
  space.max(ends);
  if (ends[0] != -ends[1])
    return fmt::format(
        "V is {:.9g} on one process and {:.9g} on another: its function must return V of all of u on each of them",
        ends[0], -ends[1]);
  constexpr Index directions = 3;
  const Index n = functions.support();
  const double scale = std::max(0.1 * space.max_norm(z.head(n)), 1e-3);
  std::mt19937_64 random(1);
  Eigen::MatrixXd d(n, directions);
  for (double& x : d.reshaped()) x = (random() & 1U) != 0 ? scale : -scale;
  const auto at = [&](std::span<const double> s) -> Vector {
    return z.head(n) + d * Eigen::Map<const Vector>(s.data(), directions);
  };
  const OwnPotential along{.value = [&](std::span<const double> s) { return functions.value(span_of(at(s))); },
                           .gradient =
                               [&](std::span<const double> s, std::span<double> out) {
                                 Vector slope(n);
                                 functions.gradient(span_of(at(s)), {slope.data(), static_cast<std::size_t>(n)});
                                 Eigen::Map<Vector>(out.data(), directions) = d.transpose() * slope;
                                 space.sum(out);
                               }};
  return gradient_complaint(along, span_of(Vector::Zero(directions)));
}

}  // namespace seiche
