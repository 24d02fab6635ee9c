// What is special to one problem: its equation written out, its invariants, what it is known for.
#include <test/support/paths.hpp>
#include <test/support/worst.hpp>

#include <seiche/backend/backends.hpp>
#include <seiche/config/case/case_file.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/law/law.hpp>
#include <seiche/problem/beta_fpu.hpp>
#include <seiche/problem/chain.hpp>
#include <seiche/problem/nls.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/study/reference.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace seiche::test {
namespace TEST_FILE {

Vector right_hand_side(const Problem& problem) {
  const System system = find_backend("dense").system(problem, {});
  Vector out(system.space->size());
  system.right_hand_side(0.0, system.initial, out);
  return out;
}

TEST(Nls, TheSystemIsTheEquation) {
  // ψ_t = i(½ψ_xx + κ|ψ|²ψ) − γψ, with differences of order two on a periodic grid.
  const Index n = 9;
  const double kappa = -0.7;
  const double gamma = 0.3;
  Problem p = nls({.grid = {.points = {n}, .length = {4.5}}, .kappa = kappa, .gamma = constant_rate(gamma)});
  p.initial.setRandom();
  const Vector rate = right_hand_side(p);
  const auto psi = [&](Index j) {
    const Index i = (j + n) % n;
    return std::complex<double>(p.initial[i], p.initial[n + i]);
  };
  for (Index j = 0; j < n; ++j) {
    const std::complex<double> second = (psi(j + 1) - 2.0 * psi(j) + psi(j - 1)) / 0.25;
    const std::complex<double> expected =
        std::complex<double>(0, 1) * (0.5 * second + kappa * std::norm(psi(j)) * psi(j)) - gamma * psi(j);
    EXPECT_NEAR(rate[j], expected.real(), 1e-13);
    EXPECT_NEAR(rate[n + j], expected.imag(), 1e-13);
  }
}

// The largest |Σ|ψⁿ|² / (Σ|ψ⁰|² e^{−2γt}) − 1| up to t = 10.
double mass_defect(std::string_view method, double gamma, double h) {
  Simulation simulation(nls({.grid = {.points = {64}, .length = {20.0}, .discretisation = Discretisation::spectral},
                             .gamma = constant_rate(gamma)}),
                        {.method = std::string(method)});
  const double start = simulation.state().z.squaredNorm();
  double worst = 0;
  const auto steps = static_cast<int>(std::lround(10 / h));
  for (int n = 1; n <= steps; ++n) {
    EXPECT_TRUE(simulation.step(h).solved());
    const double exact = start * std::exp(-2 * gamma * n * h);
    worst = worse(worst, std::abs(simulation.state().z.squaredNorm() / exact - 1));
  }
  return worst;
}

TEST(Nls, TheAveragedCrankNicolsonSchemeLosesMassAtExactlyTwiceTheRateOfTheDamping) {
  for (const double gamma : {0.0, 0.1})
    for (const double h : {1.0 / 8, 1.0 / 32}) EXPECT_LE(mass_defect("savf", gamma, h), 1e-12) << gamma << " " << h;
}

TEST(Nls, TheOtherMethodsOfOrderTwoKeepTheLawOfMassToOrderTwo) {
  for (const MethodEntry& method : methods()) {
    if (method.kind.merges_damping || method.name == "savf" || method.name == "strang_exact" || method.order > 2)
      continue;
    const double coarse = mass_defect(method.name, 0.1, 1.0 / 32);
    const double fine = mass_defect(method.name, 0.1, 1.0 / 128);
    EXPECT_GT(fine, 1e-8) << method.name;  // these do not keep it exactly
    EXPECT_GE(std::log2(coarse / fine) / 2, 1.8) << method.name << " " << coarse << " " << fine;
  }
}

// |ψ| stays in the flow of V, of which the scheme of order four loses (h|ψ|²)⁶, and falls by γ in the other.
TEST(Nls, BothFlowsOfStrangsSplittingKeepTheLawOfMass) { EXPECT_LE(mass_defect("strang_exact", 0.1, 1.0 / 32), 1e-10); }

TEST(Nls, ItsEnergyIsPromisedToFallWhereVGrowsOutward) {
  EXPECT_TRUE(promise_energy_law(nls({.kappa = -1.0, .gamma = constant_rate(0.1)}), 10).promised);
  EXPECT_FALSE(promise_energy_law(nls({.kappa = 1.0, .gamma = constant_rate(0.1)}), 10).promised);
  EXPECT_TRUE(promise_energy_law(nls({.kappa = 1.0}), 10).promised);
}

TEST(Chain, TheSystemIsTheEquation) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::dirichlet, Boundary::neumann}) {
    const Chain o{.points = 9,
                  .boundary = boundary,
                  .mass = 1.7,
                  .neighbour_spring = 0.8,
                  .neighbour_cubic = 0.6,
                  .ground_spring = 0.4,
                  .ground_cubic = -0.3,
                  .neighbour_damping = 0.2,
                  .gamma = constant_rate(0.15)};
    Problem p = chain(o);
    p.initial.setRandom();
    const Vector rate = right_hand_side(p);
    const Index n = p.grid.unknowns();
    const auto at = [&](Index field, Index j) {
      if (boundary == Boundary::periodic) return p.initial[field * n + (j + n) % n];
      if (boundary == Boundary::neumann) return p.initial[field * n + std::clamp<Index>(j, 0, n - 1)];  // no bond pulls
      return j < 0 || j >= n ? 0.0 : p.initial[field * n + j];
    };
    const auto force = [&](double d) { return o.neighbour_spring * d + o.neighbour_cubic * d * d * d; };
    for (Index j = 0; j < n; ++j) {
      const double u = at(0, j);
      const double velocity = at(1, j) / o.mass;
      const double dashpots = (at(1, j + 1) - 2 * at(1, j) + at(1, j - 1)) / o.mass;  // Δu̇
      EXPECT_NEAR(rate[j], velocity, 1e-14);
      EXPECT_NEAR(rate[n + j],
                  force(at(0, j + 1) - u) - force(u - at(0, j - 1)) - o.ground_spring * u - o.ground_cubic * u * u * u -
                      o.mass * 0.15 * velocity + o.mass * o.neighbour_damping * dashpots,
                  1e-13);
    }
  }
}

TEST(Chain, TheFirstModeOfALinearChainIsADampedOscillator) {
  Chain o{.points = 12,
          .mass = 1.5,
          .neighbour_spring = 2.0,
          .ground_spring = 0.5,
          .neighbour_damping = 0.4,
          .gamma = constant_rate(0.1),
          .initial = Chain::Initial::first_mode};
  const double s = 4 * square(std::sin(std::numbers::pi / 24));
  const double omega_squared = (o.ground_spring + o.neighbour_spring * s) / o.mass;
  const double half_rate = (0.1 + o.neighbour_damping * s) / 2;
  const double frequency = std::sqrt(omega_squared - square(half_rate));
  const double t = 4.0;
  const double amplitude =
      std::exp(-half_rate * t) * (std::cos(frequency * t) + half_rate / frequency * std::sin(frequency * t));
  for (const Boundary boundary : {Boundary::dirichlet, Boundary::neumann}) {
    o.boundary = boundary;
    const Problem p = chain(o);
    const Reference reference = make_reference(p, {0.0, t});
    for (Index j = 0; j < p.grid.unknowns(); ++j) {
      const double phase = std::numbers::pi * p.grid.coordinate(j, 0) / 12;
      EXPECT_NEAR(reference.state(1)[static_cast<std::size_t>(j)],
                  amplitude * (boundary == Boundary::neumann ? std::cos(phase) : std::sin(phase)), 1e-10);
    }
  }
}

// ½(ȧ² + ω²a²) of the first mode.
double energy_of_first_mode(const Vector& z) {
  const Index n = z.size() / 2;
  const double quarter_turn = std::numbers::pi / static_cast<double>(2 * (n + 1));
  double displacement = 0;
  double velocity = 0;
  for (Index j = 0; j < n; ++j) {
    const double shape = std::sin(2 * quarter_turn * static_cast<double>(j + 1));
    displacement += shape * z[j];
    velocity += shape * z[n + j];
  }
  const double norm_squared = static_cast<double>(n + 1) / 2;
  return (square(velocity) + square(2 * std::sin(quarter_turn) * displacement)) / (2 * norm_squared);
}

TEST(BetaFpu, TheEnergyReturnsToTheFirstMode) {
  Simulation simulation(beta_fpu(), {.method = "seisav"});
  const double start = energy_of_first_mode(simulation.physical());
  const double h = 1.0 / 8;
  double smallest = start;
  double returned = 0;
  for (int n = 0; n < 4600 * 8; ++n) {
    ASSERT_TRUE(simulation.step(h).solved());
    const double energy = energy_of_first_mode(simulation.physical());
    smallest = std::min(smallest, energy);
    if (simulation.state().t > 4000) returned = std::max(returned, energy);
  }
  EXPECT_LE(smallest, 0.1 * start);
  EXPECT_GE(returned, 0.97 * start);
}

// Of the case file: the part of the energy that is left when the pulse would be back in the middle.
double energy_left(const std::vector<std::string>& overrides) {
  const RunSpec spec = read_case(test::source_directory() + "/cases/sponge_layer.toml", overrides);
  Simulation simulation(make_problem(spec), simulation_options(spec));
  const double start = simulation.energy().H;
  while (simulation.state().t < spec.t_end) EXPECT_TRUE(simulation.step(1.0 / 16).solved());
  return simulation.energy().H / start;
}

TEST(SpongeLayer, SwallowsThePulse) {
  EXPECT_LE(energy_left({}), 2e-4);
  EXPECT_GE(energy_left({"problem.gamma=0"}), 0.999);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
