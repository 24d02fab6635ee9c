#include <seiche/potential/bond_terms.hpp>
#include <seiche/potential/on_bonds.hpp>

#include <array>
#include <vector>

namespace seiche {
namespace {

// Bonds of a chain of so many points: as many on a ring, one more between ends where u = 0, one less between free ends.
std::size_t bond_count(std::size_t points, Boundary boundary) {
  switch (boundary) {
    case Boundary::periodic: return points;
    case Boundary::dirichlet: return points + 1;
    case Boundary::neumann: break;
  }
  return points - 1;
}

// With B the differences, V = W(Bu): ∇V = Bᵀ∇W(Bu), and means and Taylor coefficients go the same way.
class OnBonds final : public PointwisePotential {
 public:
  OnBonds(std::shared_ptr<const PointwisePotential> w, Boundary boundary) : w_(std::move(w)), boundary_(boundary) {}

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
    at_points(of_slopes, bounds, [](double before, double after) { return before + after; });
  }
  int degree() const override { return w_->degree(); }
  void along(std::span<const double> p, std::span<const double> q, std::span<double> coefficients) const override {
    const std::span<const double> here = differences(p, 0);
    w_->along(here, differences(q, 1), coefficients);
  }
  int homogeneity() const override { return w_->homogeneity(); }
  bool grows_outward() const override { return w_->grows_outward(); }
  std::optional<std::vector<TermsOfPotential>> terms_at(Index first, Index count, Index of) const override {
    if (w_->at_points(0, 1)) return std::nullopt;  // bonds that are not alike
    return bond_terms(std::make_shared<const OnBonds>(w_, Boundary::neumann), boundary_, first, count, of);
  }

 private:
  // Three rows for each thread.
  static std::span<double> row(std::size_t which, std::size_t size) {
    thread_local std::array<std::vector<double>, 3> memory;
    if (memory[which].size() < size)
      for (std::vector<double>& each : memory) each.resize(size);
    return std::span(memory[which]).first(size);
  }

  // From left to right; on a ring the first one ends at unknown 0.
  std::span<const double> differences(std::span<const double> u, std::size_t which) const {
    const std::size_t n = u.size();
    const std::span<double> d = row(which, bond_count(n, boundary_));
    std::size_t bond = 0;
    if (boundary_ == Boundary::periodic) d[bond++] = u[0] - u[n - 1];
    if (boundary_ == Boundary::dirichlet) d[bond++] = u[0];
    for (std::size_t j = 1; j < n; ++j) d[bond++] = u[j] - u[j - 1];
    if (boundary_ == Boundary::dirichlet) d[bond] = -u[n - 1];
    return d;
  }

  void pull(std::span<const double> slopes, std::span<double> gradient) const {
    at_points(slopes, gradient, [](double before, double after) { return before - after; });
  }

  // out_j = f(of the bond before j, of the one after it), 0 for a bond that is not there.
  template <class F>
  void at_points(std::span<const double> of_bonds, std::span<double> out, F f) const {
    const std::size_t n = out.size();
    if (boundary_ == Boundary::neumann) {
      for (std::size_t j = 0; j < n; ++j) out[j] = f(j == 0 ? 0.0 : of_bonds[j - 1], j + 1 == n ? 0.0 : of_bonds[j]);
      return;
    }
    for (std::size_t j = 0; j + 1 < n; ++j) out[j] = f(of_bonds[j], of_bonds[j + 1]);
    out[n - 1] = f(of_bonds[n - 1], of_bonds[boundary_ == Boundary::periodic ? 0 : n]);
  }

  std::shared_ptr<const PointwisePotential> w_;
  Boundary boundary_;
};

}  // namespace

std::shared_ptr<const PointwisePotential> on_bonds(std::shared_ptr<const PointwisePotential> w, Boundary boundary) {
  return std::make_shared<OnBonds>(std::move(w), boundary);
}

}  // namespace seiche
