// What runs with noise must obey: Gibbs' measure, correlations, weak order, the balance of heat.
#include <test/support/error_of.hpp>

#include <seiche/core/grid/stencil.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/ensemble/ensemble.hpp>
#include <seiche/method/methods.hpp>
#include <seiche/potential/polynomials.hpp>
#include <seiche/problem/gradient_flow/phase_separation.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/oscillator.hpp>
#include <seiche/simulation/certificate.hpp>
#include <seiche/simulation/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

using testing::HasSubstr;

// A mean with its standard error, from independent values.
struct Mean {
  double value = 0, error = 0;
  explicit Mean(const std::vector<double>& of_independent) {
    const auto n = static_cast<double>(of_independent.size());
    value = std::accumulate(of_independent.begin(), of_independent.end(), 0.0) / n;
    double sum = 0;
    for (const double x : of_independent) sum += square(x - value);
    error = std::sqrt(sum / (n - 1) / n);
  }
};
constexpr double sigmas = 5;

SimulationOptions noisy(const std::string& method, double temperature, std::uint64_t seed = 1) {
  return {.method = method, .noise = {.temperature = temperature, .seed = seed}};
}

// ∫f e^{−V/T} / ∫e^{−V/T}, by sums.
double gibbs_mean(const std::function<double(double)>& V, const std::function<double(double)>& f, double T) {
  double sum = 0, weight = 0;
  for (double q = -8; q <= 8; q += 1e-3) {
    const double w = std::exp(-V(q) / T);
    sum += w * f(q);
    weight += w;
  }
  return sum / weight;
}

// 4096 oscillators that do not touch are as many samples at every time.
TEST(LangevinSlow, ManyOscillatorsInADoubleWellHaveGibbsMeasureAndEquipartition) {
  constexpr double T = 0.3;
  const auto V = [](double q) { return -q * q / 2 + square(square(q)) / 4; };
  for (const std::string method : {"seavf", "seisav", "egc4", "crkn4"}) {
    Simulation s(oscillator({.points = 4096, .omega_squared = -1, .gamma = constant_rate(1.0)}), noisy(method, T));
    for (int i = 0; i < 160; ++i) ASSERT_TRUE(s.step(0.25).solved());
    std::vector<double> kinetic, second, fourth;
    for (int i = 0; i < 250; ++i) {  // 10⁶ samples, a second time apart
      for (int j = 0; j < 4; ++j) ASSERT_TRUE(s.step(0.25).solved());
      const Vector z = s.physical();
      const auto q = z.head(4096).array(), p = z.tail(4096).array();
      kinetic.push_back((p * p).mean());
      second.push_back((q * q).mean());
      fourth.push_back((q * q * q * q).mean());
    }
    const auto within = [&](const std::vector<double>& all, double exact, double bias) {
      const Mean mean(all);  // neighbours in time are correlated by a factor of some two
      EXPECT_NEAR(mean.value, exact, 3 * sigmas * mean.error + bias) << method;
      EXPECT_LT(mean.error, 0.002 * exact) << method;
    };
    within(kinetic, T, 0);
    within(second,
           gibbs_mean(
               V, [](double q) { return q * q; }, T),
           0.004);
    within(fourth,
           gibbs_mean(
               V, [](double q) { return square(q * q); }, T),
           0.008);
  }
}

// ⟨q(t)q(0)⟩ = T/ω² e^{−γt/2}(cos Ωt + γ/2Ω sin Ωt), Ω² = ω² − γ²/4; ⟨p(t)p(0)⟩ = T e^{−γt/2}(cos Ωt − γ/2Ω sin Ωt).
TEST(LangevinSlow, AnOscillatorForgetsWhereItWasAsTheFormulaSays) {
  constexpr double T = 0.5, gamma = 0.8, omega = 1.5, h = 0.05;
  constexpr Index n = 1 << 16;
  Simulation s(oscillator({.points = n, .omega_squared = square(omega), .alpha = 0, .gamma = constant_rate(gamma)}),
               noisy("seisav", T, 5));
  for (int i = 0; i < 400; ++i) ASSERT_TRUE(s.step(h).solved());
  const Vector z0 = s.physical();
  const double Omega = std::sqrt(square(omega) - square(gamma) / 4);
  for (int i = 1; i <= 80; ++i) {
    ASSERT_TRUE(s.step(h).solved());
    if (i % 10 != 0) continue;
    const Vector z = s.physical();
    const double t = i * h, decay = T * std::exp(-gamma * t / 2);
    const double c = std::cos(Omega * t), sn = gamma / (2 * Omega) * std::sin(Omega * t);
    const double q = z.head(n).dot(z0.head(n)) / n, p = z.tail(n).dot(z0.tail(n)) / n;
    const double error = sigmas * T * std::sqrt(2.0 / n);
    EXPECT_NEAR(q, decay * (c + sn) / square(omega), error / square(omega) + h * h * T / 6) << t;
    EXPECT_NEAR(p, decay * (c - sn), error + h * h * T / 6) << t;
  }
}

// ⟨q²⟩, ⟨qp⟩, ⟨p²⟩ of q̈ + γq̇ − q = noise from q = 1, p = 0, whose equations are linear.
std::array<double, 3> moments_on_a_hill(double gamma, double T, double end) {
  const auto slope = [&](const std::array<double, 3>& m) {
    return std::array{2 * m[1], m[2] + m[0] - gamma * m[1], 2 * m[1] - 2 * gamma * (m[2] - T)};
  };
  std::array<double, 3> m = {1, 0, 0};
  constexpr int steps = 4000;
  for (int i = 0; i < steps; ++i) {  // Heun
    const std::array<double, 3> k = slope(m);
    std::array<double, 3> ahead = m;
    for (std::size_t j = 0; j < 3; ++j) ahead[j] += end / steps * k[j];
    const std::array<double, 3> l = slope(ahead);
    for (std::size_t j = 0; j < 3; ++j) m[j] += end / steps * (k[j] + l[j]) / 2;
  }
  return m;
}

// Errors of means far from equilibrium, with other numbers for each step size. All of the force is in V.
TEST(LangevinSlow, IsOfWeakOrderTwo) {
  constexpr double gamma = 0.5, T = 0.5, end = 2;
  constexpr Index n = 1 << 19;
  const std::array<double, 3> exact = moments_on_a_hill(gamma, T, end);
  Problem problem = oscillator({.points = n, .omega_squared = -1, .alpha = 0, .gamma = constant_rate(gamma)});
  problem.initial.head(n).setOnes();
  std::array<double, 3> errors{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double h = std::ldexp(1.0, -static_cast<int>(i));
    Simulation s(problem, noisy("seavf", T, i + 1));
    for (int k = 0; k < std::lround(end / h); ++k) ASSERT_TRUE(s.step(h).solved());
    const Vector z = s.physical();
    const std::array found = {z.head(n).squaredNorm() / n, z.head(n).dot(z.tail(n)) / n, z.tail(n).squaredNorm() / n};
    for (std::size_t j = 0; j < 3; ++j) errors[i] = std::hypot(errors[i], found[j] - exact[j]);
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[2]) / 2, 2, 0.25) << errors[0] << ' ' << errors[1] << ' ' << errors[2];
}

// In equilibrium a half-flow takes γh T/2 of each momentum by damping and gives it back by noise, and both columns say
// so; the sum of all columns is the change of H.
TEST(Langevin, TheLedgerBalancesHeatAndDamping) {
  constexpr double T = 0.7, gamma = 0.6, h = 0.5;
  constexpr Index n = 1 << 15;
  Simulation s(oscillator({.points = n, .gamma = constant_rate(gamma)}), noisy("seavf", T));
  for (int i = 0; i < 40; ++i) ASSERT_TRUE(s.step(h).solved());
  s.stepper().keep_ledger();
  StepLedger all;
  std::vector<double> heat;
  const double before = s.energy().H;
  for (int i = 0; i < 100; ++i) {
    const StepReport report = s.step(h);
    ASSERT_TRUE(report.solved());
    all += report.ledger;
    heat.push_back(report.ledger.heat / n);
  }
  EXPECT_NEAR(all.sum(), s.energy().H - before, 1e-9 * s.energy().H);
  const Mean mean(heat);
  EXPECT_NEAR(all.heat, -(all.damping_left + all.damping_right), 2 * sigmas * 100 * n * mean.error);
  EXPECT_NEAR(mean.value, T * (1 - std::exp(-gamma * h)), sigmas * mean.error);  // two half-flows, T/2 (1 − E²) each
}

// Gradient flows that do not couple points: u̇ = −H′(u) + noise. All modes are slow, and H is in V, in M, or in both.
TEST(LangevinSlow, GradientFlowsHaveGibbsMeasureWhereNothingIsFast) {
  constexpr double T = 0.3;
  struct Well {
    double in_M, in_V, quartic;
  };
  for (const Well& well : {Well{1, 0, 0}, Well{0, 1, 0}, Well{0.5, 0.5, 0}, Well{1, 0, 1}}) {
    Problem p = allen_cahn({.grid = {.points = {1 << 14}, .length = {1.0}}});
    p.M(0, 0) = Stencil::identity(well.in_M);
    p.potential = nodal_polynomial({0, 0, well.in_V / 2, 0, well.quartic / 4});
    p.initial.setZero();
    const auto H = [&](double u) { return (well.in_M + well.in_V) / 2 * u * u + well.quartic / 4 * square(u * u); };
    const double exact = gibbs_mean(
        H, [](double u) { return u * u; }, T);
    for (const std::string method : {"seavf", "egc4", "seimp"}) {
      for (const double h : {0.05, 0.2}) {
        Simulation s(p, noisy(method, T));
        std::vector<double> means;
        for (int i = 0; i < std::lround(18 / h); ++i) {
          ASSERT_TRUE(s.step(h).solved());
          if (i * h >= 6 && i % std::lround(2 / h) == 0) means.push_back(s.physical().squaredNorm() / (1 << 14));
        }
        const double bias = well.in_V + well.quartic == 0 ? 0 : h * h * T;  // of order two
        EXPECT_NEAR(Mean(means).value, exact, sigmas * exact * std::sqrt(2.0 / (1 << 14)) + bias)
            << method << ' ' << h << ' ' << well.in_M << well.in_V << well.quartic;
      }
    }
  }
}

// Cook's equation: where V = 0 every mode has the variance T/M, and the mean does not move.
TEST(Langevin, ConservedNoiseKeepsTheMeanAndGivesEveryModeItsShare) {
  constexpr double T = 0.02;
  constexpr Index points = 1 << 15;
  PhaseSeparation options;
  options.grid = {.points = {points}, .length = {512.0}};
  options.barrier = 1e-12;  // V ≈ 0
  options.kappa = 1.0;
  Problem problem = cahn_hilliard(options);
  problem.initial.setConstant(0.25);
  for (const double h : {0.01, 1.0, 1e4}) {
    Simulation s(problem, noisy("seisav", T));
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(s.step(h).solved());
    const Vector u = s.physical();
    EXPECT_NEAR(u.mean(), 0.25, 1e-12);
    EXPECT_NEAR(s.energy().H / (0.5 * T * points), 1, 0.05) << h;  // of modes that are nearly all fast
  }
}

// The same numbers for every method: what distinguishes two of order two is their error.
TEST(Langevin, MethodsAndBackendsTakeTheSameNumbers) {
  const Problem problem = klein_gordon({.grid = {.points = {16}, .length = {4.0}}, .gamma = constant_rate(0.5)});
  const auto end = [&](const std::string& method, const std::string& backend) {
    SimulationOptions options = noisy(method, 0.05);
    options.backend = backend;
    Simulation s(problem, options);
    for (int i = 0; i < 64; ++i) EXPECT_TRUE(s.step(1.0 / 64).solved());
    return s.physical();
  };
  const Vector reference = end("egc4", "modal");
  EXPECT_GT((reference - problem.initial).norm(), 0.1);
  for (const MethodEntry& method : methods()) {
    const Vector on_modal = end(std::string(method.name), "modal");
    EXPECT_LE((on_modal - reference).norm(), 2e-3 * reference.norm()) << method.name;
    EXPECT_LE((on_modal - end(std::string(method.name), "dense")).norm(), 1e-10 * reference.norm()) << method.name;
  }
  EXPECT_GT((reference -
             [&] {
               Simulation s(problem, noisy("egc4", 0.05, 2));
               for (int i = 0; i < 64; ++i) EXPECT_TRUE(s.step(1.0 / 64).solved());
               return s.physical();
             }())
                .norm(),
            0.01);
}

TEST(Langevin, RatesOfThePlaceAndTheTimeHaveNoiseOfTheirOwn) {
  constexpr double T = 0.4;
  constexpr Index n = 1 << 14;
  // Momenta of a point that is hardly damped keep what they were.
  class Layer final : public FieldRate {
   public:
    void values(double t, std::span<double> gamma) const override {
      for (std::size_t j = 0; j < gamma.size(); ++j) gamma[j] = j % 2 == 1 ? 1 + std::sin(t) : 0;
    }
    void integrals(double t, double h, std::span<double> out) const override {
      for (std::size_t j = 0; j < out.size(); ++j) out[j] = j % 2 == 1 ? h + std::cos(t) - std::cos(t + h) : 0;
    }
    bool is_constant() const override { return false; }
    double first_negative_time(double) const override { return -1; }
    double negative_seen() const override { return 0; }
    std::string text() const override { return "layer"; }
  };
  Problem problem = oscillator({.points = n, .alpha = 0, .gamma = constant_rate(0.1)});
  problem.damping.rate = nullptr;
  problem.damping.field_rate = std::make_shared<Layer>();
  problem.initial.setZero();
  Simulation s(problem, noisy("seisav", T));
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(s.step(0.1).solved());
  const Vector z = s.physical();
  double damped = 0, free = 0;
  for (Index j = 0; j < n; ++j) (j % 2 == 1 ? damped : free) += square(z[j]) + square(z[n + j]);
  EXPECT_NEAR(damped / n, T, sigmas * T * std::sqrt(2.0 / n));  // of q and p, n/2 each
  EXPECT_LT(free, 1e-9);                                        // the round-off of 1 − e^{−2γh}
}

// Members of one state differ by their noise alone; each has the numbers of its place, whoever computes it.
TEST(Langevin, MembersOfAnEnsembleHaveNumbersOfTheirOwn) {
  const auto problem = std::make_shared<const Problem>(oscillator({.gamma = constant_rate(0.4)}));
  const std::vector<EnsembleMember> members(40, {problem, problem->initial});
  EnsembleOptions options{.simulation = noisy("seisav", 0.2), .h = 0.1, .t_end = 2};
  const EnsembleResult one = run_ensemble(members, options);
  options.threads = 3;
  const EnsembleResult three = run_ensemble(members, options);
  for (std::size_t m = 0; m < members.size(); ++m) {
    EXPECT_EQ(one.members[m].final, three.members[m].final) << m;
    EXPECT_NE(one.members[m].final, one.members[(m + 1) % members.size()].final) << m;
    EXPECT_EQ(one.members[m].report.law, LawVerdict::not_promised);
  }
  Simulation alone(*problem, options.simulation);
  alone.state().stream = 7;
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(alone.step(0.1).solved());
  EXPECT_LE((alone.physical() - one.members[7].final).norm(), 1e-13);
}

TEST(Langevin, IsRefusedWhereItCannotBe) {
  const Problem wave = klein_gordon({.grid = {.points = {16}}, .gamma = constant_rate(0.5)});
  SimulationOptions options = noisy("egc4", 0.1);
  options.variable_steps = true;
  EXPECT_THAT(error_of([&] { Simulation(wave, options); }), HasSubstr("steps of one size"));
  EXPECT_THAT(error_of([&] { Simulation(allen_cahn({}), noisy("savf", 0.1)); }), HasSubstr("another propagator"));
  options = noisy("seisav", 0.1);
  options.backend = "sparse";
  options.backend_options.sparse.pade_degree = 4;
  EXPECT_THAT(error_of([&] { Simulation(allen_cahn({.grid = {.points = {8}}}), options); }), HasSubstr("write 0"));
  options = noisy("seisav", 0.1);
  options.method_options.auxiliary = AuxiliaryMode::frozen;
  EXPECT_THAT(error_of([&] { Simulation(wave, options); }), HasSubstr("no meaning beside noise"));
  const Problem feeding = klein_gordon({.grid = {.points = {16}}, .gamma = constant_rate(-0.5)});
  EXPECT_THAT(error_of([&] { certify(feeding, {.noise = {.temperature = 0.1}, .t_end = 1}); }),
              HasSubstr("no noise balances a negative damping"));
  EXPECT_EQ(Simulation(wave, noisy("auto", 0.1)).method().name, "seisav");
  const Simulation s(wave, noisy("seisav", 0.1));
  EXPECT_FALSE(promise_energy_law(s, 1).promised);
  EXPECT_THAT(promise_energy_law(s, 1).reason, HasSubstr("noise of the temperature 0.1"));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
