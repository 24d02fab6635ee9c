#include <seiche/core/base/error.hpp>
#include <seiche/core/truncated_potential.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seiche {
namespace {

// Scratch of a thread: one potential may serve several systems at once.
struct Scratch {
  std::vector<double> a, b, line;
};
Scratch& scratch() {
  static thread_local Scratch scratch;
  return scratch;
}

bool is_kept(Index k, Index period) { return 3 * std::min(k, period - k) < period; }

// N⁻¹ Σ cos(2πkd/N) over the modes |k| ≤ K that are kept, for d = 0 … N − 1: Dirichlet's kernel.
std::vector<double> kernel(Index n) {
  const Index modes = 2 * ((n - 1) / 3) + 1;
  const auto sine = [n](Index p) {  // sin(πp/N)
    return std::sin(std::numbers::pi * static_cast<double>(p % (2 * n)) / static_cast<double>(n));
  };
  std::vector<double> c(static_cast<std::size_t>(n), static_cast<double>(modes) / static_cast<double>(n));
  for (Index d = 1; d < n; ++d) c[static_cast<std::size_t>(d)] = sine(modes * d) / sine(d) / static_cast<double>(n);
  return c;
}

}  // namespace

bool is_kept(const Mode& mode) {
  for (std::size_t a = 0; a < mode.k.size(); ++a)
    if (!is_kept(mode.k[a], mode.period[a])) return false;
  return true;
}

TruncatedPotential::TruncatedPotential(std::shared_ptr<const PointwisePotential> potential, const Grid& grid)
    : potential_(std::move(potential)) {
  if (!grid.is_periodic()) throw Error("the two-thirds rule needs a grid that is periodic along every axis");
  Index stride = grid.whole().unknowns();
  for (const GridAxis& axis : grid.axes) {
    stride /= axis.unknowns();
    lines_.push_back({kernel(axis.unknowns()), static_cast<std::size_t>(stride)});
  }
}

std::shared_ptr<const PointwisePotential> TruncatedPotential::at_points(Index first, Index count) const {
  auto there = potential_->at_points(first, count);
  if (!there) return nullptr;
  auto truncated = std::make_shared<TruncatedPotential>(*this);
  truncated->potential_ = std::move(there);
  return truncated;
}

// One field after the other and line after line: out_i = Σ_j c_{i−j} u_j.
void TruncatedPotential::project(std::span<double> u) const {
  std::vector<double>& line = scratch().line;
  for (const Line& axis : lines_) {
    const std::size_t n = axis.kernel.size();
    line.resize(n);
    for (std::size_t first = 0; first < u.size(); ++first) {
      if (first / axis.stride % n != 0) continue;
      for (std::size_t i = 0; i < n; ++i) {
        double sum = 0;
        for (std::size_t j = 0; j < n; ++j) sum += axis.kernel[i >= j ? i - j : i + n - j] * u[first + j * axis.stride];
        line[i] = sum;
      }
      for (std::size_t i = 0; i < n; ++i) u[first + i * axis.stride] = line[i];
    }
  }
}

std::span<const double> TruncatedPotential::projected(std::span<const double> u, std::vector<double>& out) const {
  out.assign(u.begin(), u.end());
  project(out);
  return out;
}

double TruncatedPotential::value(std::span<const double> u) const {
  return potential_->value(projected(u, scratch().a));
}

ValueAndMagnitude TruncatedPotential::value_and_magnitude(std::span<const double> u) const {
  return potential_->value_and_magnitude(projected(u, scratch().a));
}

double TruncatedPotential::value_and_gradient(std::span<const double> u, std::span<double> gradient) const {
  const double v = potential_->value_and_gradient(projected(u, scratch().a), gradient);
  project(gradient);
  return v;
}

void TruncatedPotential::mean_gradient(std::span<const double> a, std::span<const double> b,
                                       std::span<double> mean) const {
  potential_->mean_gradient(projected(a, scratch().a), projected(b, scratch().b), mean);
  project(mean);
}

void TruncatedPotential::along(std::span<const double> p, std::span<const double> q,
                               std::span<double> coefficients) const {
  potential_->along(projected(p, scratch().a), projected(q, scratch().b), coefficients);
}

}  // namespace seiche
