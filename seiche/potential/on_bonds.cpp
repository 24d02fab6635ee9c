#include <seiche/potential/on_bonds.hpp>

#include <array>
#include <vector>

namespace seiche {
namespace {

// With B the differences, V = W(Bu): ∇V = Bᵀ∇W(Bu), and means and Taylor coefficients go the same way.
class OnBonds final : public PointwisePotential {
 public:
  OnBonds(std::shared_ptr<const PointwisePotential> w, Boundary boundary)
      : w_(std::move(w)), is_ring_(boundary == Boundary::periodic) {}

  double value(std::span<const double> u) const override { return w_->value(differences(u, 0)); }
  ValueAndMagnitude value_and_magnitude(std::span<const double> u) const override {
    return w_->value_and_magnitude(differences(u, 0));
  }
  double value_and_gradient(std::span<const double> u, std::span<double> gradient) const override {
    const std::span<const double> d = differences(u, 0);
    const std::span<double> slopes = row(2, d.size());
    const double value = w_->value_and_gradient(d, slopes);
    pull(slopes, gradient);
    return value;
  }
  void mean_gradient(std::span<const double> a, std::span<const double> b, std::span<double> mean) const override {
    const std::span<const double> before = differences(a, 0);
    const std::span<const double> after = differences(b, 1);
    const std::span<double> slopes = row(2, before.size());
    w_->mean_gradient(before, after, slopes);
    pull(slopes, mean);
  }
  void gradient_round_off(std::span<const double> u, std::span<double> bounds) const override {
    const std::span<const double> d = differences(u, 0);
    const std::span<double> of_slopes = row(2, d.size());
    w_->gradient_round_off(d, of_slopes);
    const std::size_t n = u.size();
    for (std::size_t j = 0; j < n; ++j) bounds[j] = of_slopes[j] + of_slopes[is_ring_ ? (j + 1) % n : j + 1];
  }
  int degree() const override { return w_->degree(); }
  void along(std::span<const double> p, std::span<const double> q, std::span<double> coefficients) const override {
    const std::span<const double> here = differences(p, 0);
    w_->along(here, differences(q, 1), coefficients);
  }
  int homogeneity() const override { return w_->homogeneity(); }
  bool grows_outward() const override { return w_->grows_outward(); }

 private:
  // Three rows for each thread.
  static std::span<double> row(std::size_t which, std::size_t size) {
    thread_local std::array<std::vector<double>, 3> memory;
    if (memory[which].size() < size)
      for (std::vector<double>& each : memory) each.resize(size);
    return std::span(memory[which]).first(size);
  }

  // Bond j ends at unknown j, and behind the last stands the one to the end of the chain.
  std::span<const double> differences(std::span<const double> u, std::size_t which) const {
    const std::size_t n = u.size();
    const std::span<double> d = row(which, is_ring_ ? n : n + 1);
    d[0] = u[0] - (is_ring_ ? u[n - 1] : 0.0);
    for (std::size_t j = 1; j < n; ++j) d[j] = u[j] - u[j - 1];
    if (!is_ring_) d[n] = -u[n - 1];
    return d;
  }

  void pull(std::span<const double> slopes, std::span<double> gradient) const {
    const std::size_t n = gradient.size();
    for (std::size_t j = 0; j + 1 < n; ++j) gradient[j] = slopes[j] - slopes[j + 1];
    gradient[n - 1] = slopes[n - 1] - (is_ring_ ? slopes[0] : slopes[n]);
  }

  std::shared_ptr<const PointwisePotential> w_;
  bool is_ring_;
};

}  // namespace

std::shared_ptr<const PointwisePotential> on_bonds(std::shared_ptr<const PointwisePotential> w, Boundary boundary) {
  return std::make_shared<OnBonds>(std::move(w), boundary);
}

}  // namespace seiche
