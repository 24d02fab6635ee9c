#include <seiche/core/error.hpp>
#include <seiche/core/numerics/gauss_rule.hpp>
#include <seiche/potential/own_potential.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

namespace seiche {
namespace {

using ConstMap = Eigen::Map<const Vector>;
using Map = Eigen::Map<Vector>;

ConstMap vector(std::span<const double> u) { return {u.data(), std::ssize(u)}; }
Map vector(std::span<double> u) { return {u.data(), std::ssize(u)}; }
std::span<double> span(Vector& u) { return {u.data(), static_cast<std::size_t>(u.size())}; }

class Own final : public PointwisePotential {
 public:
  explicit Own(OwnPotential own) : own_(std::move(own)) {}

  Index fields() const override { return own_.fields; }
  double value(std::span<const double> u) const override { return own_.value(u); }

  // What round-off in u makes of V, u·∇V, is counted by the sizes of its terms.
  ValueAndMagnitude value_and_magnitude(std::span<const double> u) const override {
    Vector slope(std::ssize(u));
    const double v = value_and_gradient(u, span(slope));
    return {v, (std::abs(v) + vector(u).cwiseAbs().dot(slope.cwiseAbs())) * (precision_ / epsilon)};
  }

  double value_and_gradient(std::span<const double> u, std::span<double> gradient) const override {
    own_.gradient(u, gradient);
    return own_.value(u);
  }
  void gradient(std::span<const double> u, std::span<double> out) const override { own_.gradient(u, out); }

  void mean_gradient(std::span<const double> a, std::span<const double> b, std::span<double> mean) const override {
    const Vector step = vector(b) - vector(a);
    Vector at(step.size()), slope(step.size()), sum = Vector::Zero(step.size());
    for (const GaussNode& node : rule_) {
      at = vector(a) + node.place * step;
      own_.gradient(span(at), span(slope));
      sum += node.weight * slope;
    }
    const double va = own_.value(a);
    const double vb = own_.value(b);
    const double defect = (vb - va) - sum.dot(step);
    const double round_off = 8 * precision_ * (std::abs(va) + std::abs(vb) + sum.cwiseAbs().dot(step.cwiseAbs()));
    if (std::abs(defect) > round_off) sum += (defect / step.squaredNorm()) * step;
    vector(mean) = sum;
  }

  std::string complaint(std::span<const double> u) const override {
    if (checked_) return "";  // the functions are the same at every start
    std::string text = gradient_complaint(own_, u);
    checked_ = text.empty();
    precision_ = relative_precision(own_, u);
    return text;
  }

  int degree() const override { return 0; }
  void along(std::span<const double>, std::span<const double>, std::span<double> coefficients) const override {
    std::fill(coefficients.begin(), coefficients.end(), 0.0);
  }
  bool grows_outward() const override { return own_.grows_outward; }

 private:
  OwnPotential own_;
  mutable std::atomic<bool> checked_ = false;
  mutable std::atomic<double> precision_ = epsilon;  // of V, once it was looked at
  std::vector<GaussNode> rule_ = gauss_rule(4);
};

}  // namespace

std::shared_ptr<const PointwisePotential> own_potential(OwnPotential own) {
  if (!own.value || !own.gradient) throw Error("a potential needs both functions, V and its gradient");
  if (own.fields < 1) throw Error("a potential reads {} fields; it must be one at least", own.fields);
  return std::make_shared<Own>(std::move(own));
}

}  // namespace seiche
