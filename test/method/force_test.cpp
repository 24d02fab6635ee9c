// External forces: the driven oscillator, the work they do, and what is refused.
#include <seiche/core/base/error.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/formula/formula_compiler.hpp>
#include <seiche/loop/adaptive.hpp>
#include <seiche/problem/oscillator.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/study/reference.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace seiche::test {
namespace TEST_FILE {

constexpr double gamma_rate = 0.3, omega_squared = 2.0, strength = 0.8, frequency = 1.7;

// At rest with a force that starts from nothing: neither the state nor the force at its start says how far a step goes.
Problem driven_from_rest() {
  Problem p = oscillator({.omega_squared = omega_squared, .alpha = 0, .gamma = constant_rate(gamma_rate)});
  p.forces = {nullptr, uniform_space_rate(formula_rate(compile_formula("sin(t)", {"t"})))->on(p.grid)};
  p.initial.setZero();
  return p;
}

Problem driven_oscillator() {
  Problem p = oscillator({.omega_squared = omega_squared, .alpha = 0, .gamma = constant_rate(gamma_rate)});
  p.forces = {nullptr, uniform_space_rate(formula_rate(compile_formula("0.8*cos(1.7*t)", {"t"})))->on(p.grid)};
  p.initial << 1.0, 0.5;
  return p;
}

// q̈ + γq̇ + ω²q = F cos Ωt from (1, ½), in closed form.
Vector exact(double t) {
  using Complex = std::complex<double>;
  const Complex response = strength / (omega_squared - frequency * frequency + Complex(0, gamma_rate * frequency));
  const auto driven = [&](double s) { return response * std::exp(Complex(0, frequency * s)); };
  const double q0 = 1.0 - driven(0).real();
  const double p0 = 0.5 - (Complex(0, frequency) * driven(0)).real();
  const double w = std::sqrt(omega_squared - gamma_rate * gamma_rate / 4);
  const double b = (p0 + gamma_rate / 2 * q0) / w;
  const double decay = std::exp(-gamma_rate / 2 * t);
  const double q = decay * (q0 * std::cos(w * t) + b * std::sin(w * t));
  const double p = decay * w * (b * std::cos(w * t) - q0 * std::sin(w * t)) - gamma_rate / 2 * q;
  Vector z(2);
  z << q + driven(t).real(), p + (Complex(0, frequency) * driven(t)).real();
  return z;
}

double error_at(const char* method, const char* backend, double h, double t_end) {
  Simulation simulation(driven_oscillator(), {.method = method, .backend = backend});
  while (simulation.state().t < t_end - h / 2) EXPECT_TRUE(simulation.step(h).solved());
  return (simulation.physical() - exact(t_end)).lpNorm<Eigen::Infinity>();
}

TEST(Force, TheDrivenOscillatorFollowsItsFormulaWithTheOrderOfTheMethod) {
  struct Expected {
    const char* method;
    double order;
  };
  for (const char* backend : {"dense", "modal", "sparse"})
    for (const auto& [method, order] : {Expected{"seisav", 2}, Expected{"seilm", 2}, Expected{"savf", 2},
                                        Expected{"egc2", 2}, Expected{"egc4", 4}, Expected{"egc6", 6}}) {
      const double coarse = error_at(method, backend, 0.25, 12);
      const double fine = error_at(method, backend, 0.125, 12);
      EXPECT_NEAR(std::log2(coarse / fine), order, 0.25) << method << " " << backend << " " << coarse << " " << fine;
    }
}

TEST(Force, ASystemAtRestIsSetInMotionByEveryMethodWithItsOrder) {
  const Reference reference = make_reference(driven_from_rest(), std::vector{0.0, 4.0});
  const auto error = [&](const char* method, double h) {
    Simulation simulation(driven_from_rest(), {.method = method});
    int fallbacks = 0;
    while (simulation.state().t < 4 - h / 2) fallbacks += simulation.step(h).fallbacks;
    EXPECT_EQ(fallbacks, 0) << method;
    return std::abs(simulation.physical()[0] - reference.state(1)[0]);
  };
  for (const auto& [method, order] :
       {std::pair{"egc4", 4.0}, std::pair{"egc6", 6.0}, std::pair{"egc8", 8.0}, std::pair{"etdrk4", 4.0},
        std::pair{"seimp", 2.0}, std::pair{"strang_exact", 2.0}, std::pair{"seisav", 2.0}})
    EXPECT_GE(std::log2(error(method, 0.5) / error(method, 0.25)), order - 0.5) << method;
  for (const char* method : {"egc6", "etdrk4", "seisav"}) {
    Simulation simulation(driven_from_rest(), {.method = method, .variable_steps = true});
    const RunReport report = integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                                                {.tolerance = 1e-7, .t_end = 4});
    ASSERT_EQ(report.status, RunReport::Status::success) << method << ": " << report.message;
    EXPECT_NEAR(simulation.physical()[0], reference.state(1)[0], 1e-6) << method;
  }
}

TEST(Force, AForceThatIsNaNEndsTheRunWithASentence) {
  Problem p = driven_oscillator();
  p.forces[1] = uniform_space_rate(formula_rate(compile_formula("sqrt(1-t)", {"t"})))->on(p.grid);
  for (const char* method : {"egc4", "etdrk4", "seimp", "strang_exact", "seisav"}) {
    Simulation simulation(p, {.method = method});
    StepReport report;
    for (int n = 0; n < 20 && report.solved(); ++n) report = simulation.step(0.125);
    EXPECT_FALSE(report.solved()) << method;
    EXPECT_NE(report.message, "") << method;
    EXPECT_LE(simulation.state().t, 1.0) << method;
    EXPECT_TRUE(simulation.state().z.allFinite()) << method;
  }
}

TEST(Force, AForceOnPositionsKeepsTheOrderToo) {
  Problem p = oscillator({.gamma = constant_rate(0.1)});
  p.forces = {uniform_space_rate(formula_rate(compile_formula("cos(1.7*t)", {"t"})))->on(p.grid), nullptr};
  const Reference reference = make_reference(p, std::vector{0.0, 4.0});
  for (const char* method : {"strang_exact", "seisav", "seimp", "seilm"}) {
    std::vector<double> errors;
    for (const double h : {1.0 / 16, 1.0 / 32}) {
      Simulation simulation(p, {.method = method});
      while (simulation.state().t < 4 - h / 2) EXPECT_TRUE(simulation.step(h).solved());
      errors.push_back(std::abs(simulation.physical()[0] - reference.state(1)[0]));
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.25) << method;
  }
}

TEST(Force, TheLedgerSaysWhatWorkItDid) {
  for (const char* method : {"seisav", "egc6"}) {
    Simulation simulation(driven_oscillator(), {.method = method});
    simulation.stepper().keep_ledger();
    StepLedger ledger;
    const double before = simulation.energy().H;
    const double h = 1.0 / 64;
    // ∫ F cos(Ωt) q̇ dt and ∫ γq̇² dt by the midpoint rule on the exact solution, finely.
    double work = 0, damped = 0;
    for (int n = 0; n < 640; ++n) {
      ledger += simulation.step(h).ledger;
      constexpr int parts = 16;
      for (int i = 0; i < parts; ++i) {
        const double t = (n + (i + 0.5) / parts) * h;
        const double v = exact(t)[1];
        work += h / parts * strength * std::cos(frequency * t) * v;
        damped += h / parts * gamma_rate * v * v;
      }
    }
    EXPECT_NEAR(ledger.sum(), simulation.energy().H - before, 1e-13) << method;
    const double allowed = std::string(method) == "egc6" ? 1e-6 : 1e-3;  // of the oracle, and of the method
    EXPECT_NEAR(ledger.work, work, allowed) << method;
    EXPECT_NEAR(ledger.damping_left + ledger.damping_right, -damped, allowed) << method;
    EXPECT_LE(std::abs(ledger.substep) + std::abs(ledger.projection), allowed) << method;
    EXPECT_GT(std::abs(work), 0.1);
  }
}

TEST(Force, MethodsThatMergeTheDampingRefuseItAndNameThoseThatDoNot) {
  try {
    Simulation simulation(driven_oscillator(), {.method = "eisav"});
    FAIL() << "eisav took a force";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("external force"), std::string::npos) << message;
    EXPECT_NE(message.find("seisav"), std::string::npos) << message;
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
