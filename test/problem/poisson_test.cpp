// Systems whose structure matrix changes with the state: Burgers, KdV in its quadratic energy, the rigid body.
#include <seiche/core/base/error.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/problem/burgers.hpp>
#include <seiche/problem/rigid_body.hpp>
#include <seiche/simulation/simulation.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace seiche::test {
namespace TEST_FILE {

Vector after(const Problem& problem, const char* method, const char* backend, double h, int steps) {
  Simulation simulation(problem, {.method = method, .backend = backend});
  for (int n = 0; n < steps; ++n) {
    const StepReport report = simulation.step(h);
    EXPECT_TRUE(report.solved()) << report.message;
  }
  return simulation.physical();
}

// Hopf (1950), Cole (1951): u = −2νθ_x/θ with θ_t = νθ_xx solves u_t + uu_x = νu_xx. θ₀ = exp(−∫u₀/2ν) as a Fourier
// series.
double hopf_cole(double nu, double x, double t) {
  constexpr int modes = 60, samples = 512;
  using std::numbers::pi;
  double theta = 0, slope = 0;
  for (int k = 0; k <= modes; ++k) {
    double a = 0;  // θ₀ is even about 0
    for (int j = 0; j < samples; ++j) {
      const double y = static_cast<double>(j) / samples;
      a += std::exp(-(1 - std::cos(2 * pi * y)) / (2 * pi) / (2 * nu)) * std::cos(2 * pi * k * y) / samples;
    }
    if (k > 0) a *= 2;
    const double w = 2 * pi * k;
    theta += a * std::exp(-nu * w * w * t) * std::cos(w * x);
    slope -= a * w * std::exp(-nu * w * w * t) * std::sin(w * x);
  }
  return -2 * nu * slope / theta;
}

TEST(Poisson, BurgersEquationFollowsHopfAndColeWithTheOrderOfTheMethod) {
  const double nu = 0.05, t_end = 0.5;
  const Problem problem = burgers({.points = 64, .nu = nu});
  for (const auto& [method, order, steps] :
       {std::tuple{"egc2", 2.0, 64}, std::tuple{"egc4", 4.0, 64}, std::tuple{"egc6", 6.0, 64}}) {
    std::vector<double> errors;
    for (const int n : {steps, 2 * steps}) {
      const Vector u = after(problem, method, "modal", t_end / n, n);
      double worst = 0;
      for (Index j = 0; j < u.size(); ++j)
        worst = std::max(worst, std::abs(u[j] - hopf_cole(nu, problem.grid.coordinate(j, 0), t_end)));
      errors.push_back(worst);
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), order, 0.4) << method << " " << errors[0] << " " << errors[1];
  }
  const Vector u = after(problem, "egc8", "modal", 1.0 / 64, 32);
  for (Index j = 0; j < u.size(); ++j) EXPECT_NEAR(u[j], hopf_cole(nu, problem.grid.coordinate(j, 0), t_end), 1e-8);
}

TEST(Poisson, ASolitaryWaveOfKdvTravelsRoundItsBoxAndKeepsEnergyAndMean) {
  const Problem problem = burgers({.length = 40, .points = 128, .alpha = 6, .epsilon = 1, .nu = 0, .soliton = true});
  Simulation simulation(problem, {.method = "egc6"});
  const double H = simulation.energy().H;
  const double h = 1.0 / 32;
  for (int n = 0; n < 40 * 32; ++n) ASSERT_TRUE(simulation.step(h).solved());  // speed 1
  const Vector u = simulation.physical();
  EXPECT_NEAR(simulation.energy().H, H, 1e-13 * H);
  EXPECT_NEAR(u.mean(), problem.initial.mean(), 1e-14);
  EXPECT_LE((u - problem.initial).lpNorm<Eigen::Infinity>(), 2e-6);
}

TEST(Poisson, TheMeanOfADampedWaveDecaysExactly) {
  Problem problem = burgers({.points = 32, .nu = 0.02, .gamma = constant_rate(0.7)});
  problem.initial.array() += 0.4;
  for (const double h : {1.0 / 64, 0.5}) {
    Simulation simulation(problem, {.method = "egc4"});
    const double mean = simulation.physical().mean();
    for (int n = 0; n < 20; ++n) ASSERT_TRUE(simulation.step(h).solved());
    EXPECT_NEAR(simulation.physical().mean(), mean * std::exp(-0.7 * simulation.state().t), 1e-13) << h;
  }
}

// With D = γI the equation is that of the free body in another time: L(t) = e^{−γt} L₀(τ), τ = (1 − e^{−γt})/γ.
TEST(Poisson, ARigidBodyWithFrictionIsTheFreeOneInSlowerTime) {
  const double gamma = 0.3, t_end = 6;
  const double tau = -std::expm1(-gamma * t_end) / gamma;
  const Vector free = after(rigid_body(), "egc8", "dense", tau / 256, 256);
  for (const auto& [method, order, steps] :
       {std::tuple{"egc2", 2.0, 128}, std::tuple{"egc4", 4.0, 64}, std::tuple{"egc6", 6.0, 32}}) {
    std::vector<double> errors;
    for (const int n : {steps, 2 * steps}) {
      const Vector L = after(rigid_body({.gamma = constant_rate(gamma)}), method, "dense", t_end / n, n);
      errors.push_back((L - std::exp(-gamma * t_end) * free).lpNorm<Eigen::Infinity>());
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), order, 0.4) << method << " " << errors[0] << " " << errors[1];
  }
}

TEST(Poisson, AFreeRigidBodyKeepsItsEnergyAtAnyStepSize) {
  // At h = 4 nothing is resolved: there H comes by bisection from below.
  for (const auto& [h, allowed] : {std::pair{1.0 / 16, 1e-14}, std::pair{0.5, 1e-14}, std::pair{4.0, 1e-10}}) {
    Simulation simulation(rigid_body(), {.method = "egc4"});
    const double H = simulation.energy().H;
    for (int n = 0; n < 400; ++n) ASSERT_TRUE(simulation.step(h).solved());
    EXPECT_NEAR(simulation.energy().H, H, allowed) << h;
  }
}

TEST(Poisson, MethodsForOneStructureMatrixRefuseItAndNameThoseThatTakeIt) {
  for (const char* method : {"seisav", "eisav", "avf"}) {
    try {
      Simulation simulation(rigid_body(), {.method = method});
      FAIL() << method << " took S(z)";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("egc"), std::string::npos) << error.what();
    }
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
