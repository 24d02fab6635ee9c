#include <seiche/core/base/error.hpp>
#include <seiche/problem/burgers.hpp>
#include <seiche/problem/common/problem_rows.hpp>
#include <seiche/problem/common/wave.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace seiche {
namespace {

// S'(u)w = −(α/3)(u ∂w + ∂(uw)). With w = u its sum over the grid vanishes, as ∂ is skew: the mean of u stays.
class Transport final : public PointwiseStructure {
 public:
  explicit Transport(double alpha) : alpha_(alpha) {}

  void apply(std::span<const double> u, std::span<const double> w, Derivative derivative,
             std::span<double> out) const override {
    thread_local std::vector<double> product, of_product;
    product.resize(u.size());
    of_product.resize(u.size());
    for (std::size_t i = 0; i < u.size(); ++i) product[i] = u[i] * w[i];
    derivative(product, 0, of_product);
    derivative(w, 0, out);
    for (std::size_t i = 0; i < u.size(); ++i) out[i] = -alpha_ / 3 * (u[i] * out[i] + of_product[i]);
  }
  bool keeps_means() const override { return true; }
  std::string text() const override { return "S(u) = −ε∂³ − (α/3)(u∂ + ∂u)"; }

 private:
  double alpha_;
};

// u = 3c/α sech²(√(c/ε)(x − L/2)/2), which moves with the speed c = 1.
double solitary_wave(const Burgers& options, double x) {
  const double s = 1 / std::cosh(std::sqrt(1 / options.epsilon) * (x - options.length / 2) / 2);
  return 3 / options.alpha * s * s;
}

}  // namespace

Problem burgers(const Burgers& options) {
  if (options.soliton && (options.epsilon <= 0 || options.alpha == 0))
    throw Error("a solitary wave needs epsilon = {} > 0 and alpha = {} ≠ 0; or take initial = \"sine\"",
                options.epsilon, options.alpha);
  Problem p;
  p.name = "burgers";
  p.grid.axes = {{options.points, options.length, Boundary::periodic}};
  p.fields = {"u"};
  p.S = BlockStencil(1);
  p.S(0, 0) = -options.epsilon * Stencil::third_derivative(p.grid, 0, options.discretisation);
  p.M = BlockStencil(1);
  p.M(0, 0) = Stencil::identity();
  p.damping = rate_damping(options.gamma, p.grid, {true});
  p.damping.constant(0, 0) = -options.nu * Stencil::laplacian(p.grid, options.discretisation);
  p.structure = std::make_shared<Transport>(options.alpha);
  p.derivatives = {Stencil::derivative(p.grid, 0, options.discretisation)};
  p.initial = sample(p.grid, [&](double x) {
    return options.soliton ? solitary_wave(options, x) : std::sin(2 * std::numbers::pi * x / options.length);
  });
  return p;
}

ProblemEntry burgers_entry() {
  using P = Burgers;
  return ProblemRows<P>({.name = "burgers",
                         .title = "Burgers and Korteweg–de Vries equations",
                         .equation = "u_t + αuu_x + εu_xxx − νu_xx + γu = 0, periodic, with H = ½∫u²",
                         .reference = "Burgers (1948); Korteweg, de Vries (1895)",
                         .fields = {"u"},
                         .meanings = {"velocity"},
                         .default_h = "1/256",
                         .default_end = 1.0,
                         .default_method = "egc6"},
                        burgers)
      .row(&P::length, {.name = "length", .meaning = "L, the period in x", .minimum = 0, .minimum_excluded = true})
      .row(&P::points,
           {.name = "points", .meaning = "N, grid points in one period", .minimum = 5, .maximum = most_intervals})
      .row(discretisation_parameter(), [](P& p, const ParameterValues& v) { p.discretisation = discretisation_of(v); })
      .row(&P::alpha, {.name = "alpha", .meaning = "α, strength of the transport"})
      .row(&P::epsilon, {.name = "epsilon", .meaning = "ε, dispersion: α = 6, ε = 1 is KdV"})
      .row(&P::nu, {.name = "nu", .meaning = "ν, viscosity", .minimum = 0})
      .row(&P::gamma, {.name = "gamma", .meaning = "γ, damping rate, 1/time"})
      .presets(&P::soliton, {"sine", "soliton"});
}

}  // namespace seiche
