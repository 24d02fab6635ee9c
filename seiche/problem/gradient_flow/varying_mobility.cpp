#include <seiche/core/base/error.hpp>
#include <seiche/problem/gradient_flow/varying_mobility.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace seiche {
namespace {

class VaryingMobility : public PointwiseStructure {
 public:
  VaryingMobility(StateFunctionPointer M, double m, bool conserves_mean)
      : M_(std::move(M)), m_(m), conserves_mean_(conserves_mean) {}

  bool keeps_means() const override { return conserves_mean_; }
  bool dissipates() const override { return true; }
  std::string complaint_about(std::span<const double> z) const override {
    for (const double u : z)
      if (!((*M_)(u) >= 0)) return complaint_at(u);
    return "";
  }
  std::string text() const override {
    return conserves_mean_ ? fmt::format("S(u) = ∇·({})∇", M_->text()) : fmt::format("S(u) = −({})", M_->text());
  }

 protected:
  // M(u) − m; NaN stays NaN.
  double excess(double u) const {
    const double M = (*M_)(u);
    return M < 0 ? -m_ : M - m_;
  }

 private:
  std::string complaint_at(double u) const {
    return fmt::format("the mobility {} is {:.6g} at u = {:.6g}, and must be ≥ 0", M_->text(), (*M_)(u), u);
  }

  StateFunctionPointer M_;
  double m_;
  bool conserves_mean_;
};

class LocalMobility final : public VaryingMobility {
 public:
  using VaryingMobility::VaryingMobility;
  void apply(std::span<const double> u, std::span<const double> w, Derivative, std::span<double> out) const override {
    for (std::size_t j = 0; j < u.size(); ++j) out[j] = -excess(u[j]) * w[j];
  }
};

// Of spectral derivatives, Σ ∂((M − m)∂w).
class SpectralMobility final : public VaryingMobility {
 public:
  SpectralMobility(StateFunctionPointer M, double m, Index axes)
      : VaryingMobility(std::move(M), m, true), axes_(axes) {}
  void apply(std::span<const double> u, std::span<const double> w, Derivative derivative,
             std::span<double> out) const override {
    thread_local std::vector<double> factor, flux, part;  // no step allocates
    for (std::vector<double>* v : {&factor, &flux, &part}) v->resize(u.size());
    for (std::size_t j = 0; j < u.size(); ++j) factor[j] = excess(u[j]);
    std::fill(out.begin(), out.end(), 0.0);
    for (Index axis = 0; axis < axes_; ++axis) {
      derivative(w, axis, flux);
      for (std::size_t j = 0; j < u.size(); ++j) flux[j] *= factor[j];
      derivative(flux, axis, part);
      for (std::size_t j = 0; j < u.size(); ++j) out[j] += part[j];
    }
  }

 private:
  Index axes_;
};

// Between neighbours (M − m)(w_{j+1} − w_j)/Δx²: no flux leaves through a Neumann end, and beyond a Dirichlet end u and
// w vanish.
class FluxMobility final : public VaryingMobility {
 public:
  FluxMobility(StateFunctionPointer M, double m, Grid grid)
      : VaryingMobility(std::move(M), m, true), grid_(std::move(grid)) {}

  bool keeps_means() const override { return !is_held(); }

  void apply(std::span<const double> u, std::span<const double> w, Derivative, std::span<double> out) const override {
    thread_local std::vector<double> factor;  // no step allocates
    factor.resize(u.size());
    for (std::size_t j = 0; j < u.size(); ++j) factor[j] = excess(u[j]);
    std::fill(out.begin(), out.end(), 0.0);
    const double at_end = is_held() ? excess(0) : 0;
    Index stride = grid_.unknowns();
    for (Index a = 0; a < grid_.dimension(); ++a) {
      const Index n = grid_.axis(a).unknowns();
      stride /= n;
      for (Index before = 0; before < grid_.unknowns(); before += n * stride)
        for (Index line = before; line < before + stride; ++line)
          add_line(grid_.axis(a), line, stride, at_end, factor, w, out);
    }
  }

 private:
  bool is_held() const {
    return std::any_of(grid_.axes.begin(), grid_.axes.end(),
                       [](const GridAxis& axis) { return axis.boundary == Boundary::dirichlet; });
  }

  // One line of points along an axis, from `first` on.
  static void add_line(const GridAxis& axis, Index first, Index stride, double at_end, std::span<const double> factor,
                       std::span<const double> w, std::span<double> out) {
    const Index n = axis.unknowns();
    const double weight = 1 / (2 * square(axis.dx()));
    const auto at = [&](Index i) { return static_cast<std::size_t>(first + i * stride); };
    const auto exchange = [&](std::size_t j, std::size_t k) {
      const double flux = weight * (factor[j] + factor[k]) * (w[k] - w[j]);
      out[j] += flux;
      out[k] -= flux;
    };
    for (Index i = 0; i + 1 < n; ++i) exchange(at(i), at(i + 1));
    if (axis.boundary == Boundary::periodic && n > 1) exchange(at(n - 1), at(0));
    if (axis.boundary != Boundary::dirichlet) return;
    for (const std::size_t j : {at(0), at(n - 1)}) out[j] -= weight * (factor[j] + at_end) * w[j];
  }

  Grid grid_;
};

}  // namespace

void add_varying_mobility(Problem& p, StateFunctionPointer M, double m, bool conserves_mean, const GridOptions& grid) {
  if (!conserves_mean) {
    p.structure = std::make_shared<LocalMobility>(std::move(M), m, false);
    return;
  }
  if (grid.discretisation == Discretisation::fd2) {
    p.structure = std::make_shared<FluxMobility>(std::move(M), m, p.grid);
    return;
  }
  if (grid.discretisation != Discretisation::spectral || !p.grid.is_periodic())
    throw Error(
        "a mobility that follows u needs discretisation = \"fd2\", or \"spectral\" with every axis periodic; give it as a number, or "
        "choose one of them");
  for (Index axis = 0; axis < p.grid.dimension(); ++axis)
    p.derivatives.push_back(Stencil::derivative(p.grid, axis, grid.discretisation));
  p.structure = std::make_shared<SpectralMobility>(std::move(M), m, p.grid.dimension());
}

double middle_mobility(const StateFunction& M, double low, double high) {
  constexpr int samples = 1000;
  const double margin = 0.1 * (high - low);
  double least = std::numeric_limits<double>::infinity(), largest = 0;
  for (int i = 0; i <= samples; ++i) {
    const double u = low - margin + i * (high - low + 2 * margin) / samples;
    const double value = M(u);
    if (!std::isfinite(value)) throw Error("the mobility {} is {} at u = {:.6g}", M.text(), value, u);
    least = std::min(least, std::max(value, 0.0));
    largest = std::max(largest, value);
  }
  if (!(largest > 0)) throw Error("the mobility {} is nowhere > 0 from u = {:.6g} to {:.6g}", M.text(), low, high);
  return (least + largest) / 2;
}

}  // namespace seiche
