// The scalar equation of the multiplier methods, and the fallbacks of its robust solver.
#include <test/support/cases.hpp>
#include <test/support/convergence.hpp>

#include <seiche/method/closure/multiplier.hpp>
#include <seiche/potential/cosine.hpp>
#include <seiche/potential/nodal.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace seiche::test {
namespace TEST_FILE {

// Hides that a potential is a polynomial, so that the general path of the equation is taken.
class Opaque final : public PointwisePotential {
 public:
  explicit Opaque(std::shared_ptr<const PointwisePotential> inner) : inner_(std::move(inner)) {}
  double value(std::span<const double> u) const override { return inner_->value(u); }
  ValueAndMagnitude value_and_magnitude(std::span<const double> u) const override {
    return inner_->value_and_magnitude(u);
  }
  double value_and_gradient(std::span<const double> u, std::span<double> g) const override {
    return inner_->value_and_gradient(u, g);
  }
  void mean_gradient(std::span<const double> a, std::span<const double> b, std::span<double> m) const override {
    inner_->mean_gradient(a, b, m);
  }
  int degree() const override { return 0; }
  void along(std::span<const double>, std::span<const double>, std::span<double>) const override { FAIL(); }
  bool grows_outward() const override { return inner_->grows_outward(); }

 private:
  std::shared_ptr<const PointwisePotential> inner_;
};

TEST(Multiplier, ThePolynomialAndTheGeneralPathGiveTheSameFunction) {
  const Problem polynomial = klein_gordon_case();
  Problem general = polynomial;
  general.potential = std::make_shared<Opaque>(polynomial.potential);
  const System a = find_backend("dense").system(polynomial, {});
  const System b = find_backend("dense").system(general, {});
  std::srand(3);
  const Vector z = a.initial;
  const Vector delta = 0.1 * Vector::Random(z.size());
  const Vector z_plus = z + delta;
  const Vector q = 0.05 * Vector::Random(z.size());
  Vector g = Vector::Zero(z.size());
  a.potential->gradient(z + 0.5 * delta, g);
  MultiplierEquation first(*a.space, *a.potential);
  MultiplierEquation second(*b.space, *b.potential);
  const MultiplierEquation::Line line{.z = z, .z_plus = z_plus, .delta = delta, .q = q, .g = g, .e = g};
  first.set(line);
  second.set(line);
  for (const double x : {0.0, 0.3, -1.0, 2.5}) {
    const auto p = first.at(x);
    const auto s = second.at(x);
    // and both the definition V(z⁺) − V(z) − (ĝ + xe)ᵀδ
    const double defined =
        a.potential->value(z_plus + x * q) - a.potential->value(z) - ((1 + x) * g).dot(delta + x * q);
    EXPECT_NEAR(p.F, defined, 1e-14);
    EXPECT_NEAR(s.F, defined, 1e-14);
    EXPECT_NEAR(p.slope, s.slope, 1e-13);
    const double step = 1e-6;
    EXPECT_NEAR(p.slope, (first.at(x + step).F - first.at(x - step).F) / (2 * step), 1e-8);
  }
}

TEST(Multiplier, MethodsWorkAndKeepTheirLawForAPotentialThatIsNoPolynomial) {
  Problem sine_gordon = klein_gordon_case(0.1, 0.0);
  sine_gordon.potential = std::make_shared<NodalPotential<Cosine>>(Cosine{});
  sine_gordon.initial *= 4;
  const std::vector<double> h = {1.0 / 16, 1.0 / 32, 1.0 / 64, 1.0 / 128};
  const Reference reference = make_reference(sine_gordon, sample_times(h, 10.0));
  for (const MethodEntry& method : methods()) {
    std::vector<double> errors;
    for (const double step : h) {
      const Errors e = errors_against(reference, sine_gordon, {.method = std::string(method.name)}, step);
      EXPECT_EQ(e.failure, "");
      errors.push_back(e.solution);
    }
    if (method.order == 2) {
      EXPECT_NEAR(fitted_order(h, errors), 2.0, method.kind.takes_solver ? 0.3 : 0.1)
          << method.name << table(h, errors);
    } else {
      const double round_off = method.kind.takes_linear ? 1e-12 : 1e-13;  // up to eleven flows a step
      EXPECT_LE(errors[1], std::max(round_off, errors[0] * std::pow(2.0, 0.5 - method.order)))
          << method.name << table(h, errors);
    }
    Simulation simulation(sine_gordon, {.method = std::string(method.name)});
    EnergyReading before = simulation.energy();
    for (int n = 0; n < 500; ++n) {
      const StepReport report = simulation.step(0.1);
      ASSERT_TRUE(report.solved()) << method.name << " step " << n << ": " << report.message;
      const EnergyReading after = simulation.energy();
      ASSERT_LE(after.modified - before.modified, before.modified_round_off) << method.name << " step " << n;
      before = after;
    }
  }
}

TEST(Multiplier, TheRobustSolverLeavesNoStepUnresolvedWherePlainNewtonDoes) {
  const Problem p = gkdv_case(0.1, 1.0, 1.0);
  long long unresolved_newton = 0;
  long long fallbacks = 0;
  for (const double h : {1.0 / 8, 1.0 / 16, 1.0 / 32, 1.0 / 64}) {
    SimulationOptions plain{.method = "seilm"};
    plain.method_options.scalar_solver = ScalarSolver::newton;
    Simulation newton(p, plain);
    Simulation robust(p, {.method = "seilm"});
    for (double t = 0; t < 50 - h / 2; t += h) {
      const StepReport a = newton.step(h);
      unresolved_newton += a.solved() ? a.unresolved : 1;
      const StepReport b = robust.step(h);
      ASSERT_TRUE(b.solved()) << b.message;
      EXPECT_EQ(b.unresolved, 0);
      fallbacks += b.fallbacks;
      EXPECT_EQ(b.replaced.count, 0) << "what these fall back to is accurate";
    }
  }
  EXPECT_GT(unresolved_newton, 0);
  EXPECT_GT(fallbacks, 0);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
