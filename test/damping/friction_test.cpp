// Friction beyond linear: flows, orders, oscillators with known limits.
#include <test/support/cases.hpp>
#include <test/support/convergence.hpp>

#include <seiche/core/base/error.hpp>
#include <seiche/core/momenta.hpp>
#include <seiche/damping/formula_frictions.hpp>
#include <seiche/damping/frictions.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/ensemble/ensemble.hpp>
#include <seiche/formula/formula_compiler.hpp>
#include <seiche/law/law.hpp>
#include <seiche/loop/adaptive.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/oscillator.hpp>
#include <seiche/simulation/certificate.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/simulation/solve.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace seiche::test {
namespace TEST_FILE {

FrictionFormula formula(const char* text) { return {.formula = compile_formula(text, {"v", "u", "t", "x", "y", "z"})}; }

const Grid one_point{.axes = {{1, 1.0, Boundary::periodic}}};

struct NamedFriction {
  const char* name;
  FrictionPointer friction;
};

std::vector<NamedFriction> smooth_frictions() {
  return {{"quadratic", quadratic_friction(0, 0.7)},
          {"linear and quadratic", quadratic_friction(0.4, 0.7)},
          {"cubic", cubic_friction(1.3)},
          {"tanh", saturating_friction(0.5, 0.1)},
          {"isotropic", isotropic_friction(0.9, 1)},
          {"position", position_friction(formula("0.3 + u^2"), one_point)}};
}

// v̇ = −wR by so many classical Runge–Kutta steps.
double by_runge_kutta(const Friction& friction, double v, double u, double w, double h) {
  constexpr int steps = 20000;
  const double dt = h / steps;
  const auto f = [&](double x) {
    double r = 0;
    friction.force(0, {&u, 1}, {&x, 1}, {&r, 1});
    return -w * r;
  };
  for (int n = 0; n < steps; ++n) {
    const double k1 = f(v), k2 = f(v + dt / 2 * k1), k3 = f(v + dt / 2 * k2), k4 = f(v + dt * k3);
    v += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return v;
}

TEST(Friction, FlowsOfTheClosedFormsAreExact) {
  for (const auto& [name, friction] : smooth_frictions())
    for (const double v0 : {-2.0, -0.3, 0.01, 1.0, 4.0})
      for (const double w : {1.0, 0.4}) {
        const double u = 0.8, h = 0.9;
        double v = v0;
        friction->flow(0, h, w, {&u, 1}, {&v, 1});
        EXPECT_NEAR(v, by_runge_kutta(*friction, v0, u, w, h), 2e-11) << name << " from " << v0;
      }
}

TEST(Friction, AFlowInTwoPartsIsTheFlowOfBoth) {
  std::vector<NamedFriction> all = smooth_frictions();
  all.push_back({"dry", dry_friction(0.6)});
  all.push_back({"tanh, fast", saturating_friction(0.5, 0.003)});
  for (const auto& [name, friction] : all)
    for (const double v0 : {-2.0, -0.3, 0.01, 1.0, 4.0}) {
      const double u = 0.8;
      double whole = v0, parts = v0;
      friction->flow(0, 1.1, 1, {&u, 1}, {&whole, 1});
      friction->flow(0, 0.4, 1, {&u, 1}, {&parts, 1});
      friction->flow(0.4, 0.7, 1, {&u, 1}, {&parts, 1});
      EXPECT_NEAR(parts, whole, 4e-15 * std::abs(v0)) << name << " from " << v0;
      EXPECT_LE(std::abs(whole), std::abs(v0)) << name;
    }
}

TEST(Friction, DryFrictionStopsAndStays) {
  const FrictionPointer dry = dry_friction(0.5);
  double v = -0.75;
  dry->flow(0, 1.0, 1, {}, {&v, 1});
  EXPECT_DOUBLE_EQ(v, -0.25);
  dry->flow(1, 1.0, 1, {}, {&v, 1});
  EXPECT_EQ(v, 0);
}

TEST(Friction, IsotropicDragLooksAtTheLengthOfTheVelocity) {
  const FrictionPointer drag = isotropic_friction(2.0, 2);
  std::vector<double> v = {3.0, 0.0, 4.0, 1.0};  // two points: (3, 4) and (0, 1)
  drag->flow(0, 0.1, 1, {}, v);
  EXPECT_DOUBLE_EQ(v[0], 3.0 / 2);
  EXPECT_DOUBLE_EQ(v[2], 4.0 / 2);
  EXPECT_DOUBLE_EQ(v[3], 1.0 / 1.2);
}

TEST(Friction, TheMidpointDiscreteGradientTakesExactlyItsPowerFromTheEnergy) {
  const FrictionPointer friction = formula_friction(formula("sinh(v) + u^2*v"), one_point);
  for (const double v0 : {-6.0, -0.5, 0.0, 0.2, 3.0})
    for (const double h : {0.01, 1.0, 100.0}) {
      const double u = 0.7;
      double v = v0;
      friction->flow(0, h, 0.5, {&u, 1}, {&v, 1});
      const double m = (v + v0) / 2;
      const double taken = 0.5 * h * m * (std::sinh(m) + u * u * m);
      EXPECT_NEAR((v * v - v0 * v0) / 2, -taken, 1e-13 * (1 + v0 * v0)) << v0 << " " << h;
      EXPECT_LE(std::abs(v), std::abs(v0) * (1 + 1e-15));
    }
}

TEST(Friction, AFlowOfOnesOwnThatRaisesTheEnergyIsScaledBackAndCounted) {
  const auto linear = [](double, std::span<const double>, std::span<const double> v, std::span<double> r) {
    for (std::size_t i = 0; i < v.size(); ++i) r[i] = 0.1 * v[i];
  };
  const auto wrong = [](double, double h, double w, std::span<const double>, std::span<double> v) {
    for (double& x : v) x *= 1 + 0.1 * w * h;  // grows
  };
  Problem problem = klein_gordon_case(0, 1.0);
  problem.friction = own_friction({.force = linear, .flow = wrong});
  Simulation simulation(problem, {.method = "seavf"});
  double H = simulation.energy().H;
  int fallbacks = 0;
  for (int n = 0; n < 50; ++n) {
    fallbacks += simulation.step(0.1).fallbacks;
    const EnergyReading now = simulation.energy();
    EXPECT_LE(now.H, H + now.round_off);
    H = now.H;
  }
  EXPECT_GE(fallbacks, 100);
}

TEST(Friction, MethodsKeepTheirOrdersUnderFriction) {
  struct Expected {
    const char* method;
    double order, tolerance;
    std::vector<double> h;
  };
  const std::vector<Expected> expected = {{"seisav", 2, 0.15, {1.0 / 16, 1.0 / 32, 1.0 / 64, 1.0 / 128}},
                                          {"seavf", 2, 0.15, {1.0 / 16, 1.0 / 32, 1.0 / 64, 1.0 / 128}},
                                          {"egc4", 4, 0.3, {1.0 / 8, 1.0 / 16, 1.0 / 32, 1.0 / 64}},
                                          {"egc6", 6, 0.4, {1.0 / 8, 1.0 / 16, 1.0 / 32}}};
  std::vector<std::pair<std::string, Problem>> problems;
  for (const auto& [name, problem] : beyond_linear_cases())
    if (name == "KG_cubic_friction" || name == "KG_friction_by_position" || name == "Duffing_formula_friction" ||
        name == "van_der_Pol" || name == "KG_forced")
      problems.emplace_back(name, problem);
  ASSERT_EQ(problems.size(), 5U);
  for (const auto& [name, problem] : problems) {
    const Reference reference = make_reference(problem, sample_times(std::vector{1.0 / 128}, 4.0));
    for (const Expected& e : expected) {
      std::vector<double> errors;
      for (const double h : e.h) {
        const Errors found = errors_against(reference, problem, {.method = e.method}, h);
        EXPECT_EQ(found.failure, "") << name << " " << e.method;
        errors.push_back(found.solution);
      }
      EXPECT_NEAR(fitted_order(e.h, errors), e.order, e.tolerance) << name << " " << e.method << table(e.h, errors);
    }
  }
}

// Of van der Pol's equation with μ = 1 as any high-order integration gives them: see Amore, Boyd, Fernández (2018),
// Appl. Math. Comput. 324, for the amplitude 2.00861986087… and the period 6.66328685932….
TEST(Friction, VanDerPolsOscillatorFindsItsLimitCycle) {
  Problem problem = oscillator({.alpha = 0});
  problem.friction = position_friction(formula("u^2 - 1"), problem.grid);
  problem.initial << 2.0, 0.0;
  for (const char* backend : {"dense", "modal", "sparse"}) {
    Simulation simulation(problem, {.method = "egc6", .backend = backend, .variable_steps = true});
    const Space& space = *simulation.system().space;
    std::vector<double> times, amplitudes;
    const Event turning{.g = [&](double, const Vector& z) { return space.physical(z)[1]; },
                        .action =
                            [&](State& s) {
                              times.push_back(s.t);
                              amplitudes.push_back(space.physical(s.z)[0]);
                              return true;
                            },
                        .direction = Event::Direction::falling};
    const RunReport report = integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                                                {.tolerance = 1e-11, .t_end = 60, .events = {&turning, 1}});
    EXPECT_EQ(report.status, RunReport::Status::success) << report.message;
    ASSERT_GE(times.size(), 4U);
    EXPECT_NEAR(amplitudes.back(), 2.00861986087, 1e-9) << backend;
    EXPECT_NEAR(times.back() - times[times.size() - 2], 6.66328685932, 1e-9) << backend;
  }
}

// Between the coordinates that are tried before a run it feeds, and the run meets that.
TEST(Friction, FrictionThatARunSeesFeedingEnergyIsKnownAfterIt) {
  Problem problem = oscillator({.alpha = 0});
  problem.initial << -1.0, 0.0;
  problem.friction = formula_friction(formula("v*(1 - 2*exp(-((u+0.37)/0.005)^2))"), problem.grid);
  EXPECT_TRUE(promise_energy_law(problem, 10).promised);
  for (const char* method : {"seisav", "egc4"}) {
    problem.friction = formula_friction(formula("v*(1 - 2*exp(-((u+0.37)/0.005)^2))"), problem.grid);
    Simulation simulation(problem, {.method = method});
    EXPECT_EQ(problem.friction->fed_at(), "");
    for (int n = 0; n < 1280; ++n) ASSERT_TRUE(simulation.step(1.0 / 256).solved());
    EXPECT_NE(problem.friction->fed_at(), "") << method;
  }
}

TEST(Friction, FrictionThatIsNaNSomewherePromisesNoLaw) {
  for (const char* r : {"sqrt(-1-v^2)", "v+0*sqrt(-1-v^2)", "v*sqrt(1-v^2)"}) {
    const FrictionPointer friction = formula_friction(formula(r), one_point);
    EXPECT_NE(friction->feeds_at(1).find(", where R = nan"), std::string::npos) << r << ": " << friction->feeds_at(1);
  }
}

TEST(Friction, FrictionThatFeedsEnergyAtTimesIsFoundWhateverThePeriod) {
  const FrictionFormula c{.formula = compile_formula("0.2 + cos(3.141592653589793*t)", {"v", "u", "t", "x", "y", "z"}),
                          .uses_u = false,
                          .uses_place = false};
  EXPECT_NE(position_friction(c, one_point)->feeds_at(32), "");
}

TEST(Friction, DryFrictionKeepsTheLawOfEveryMethodAndIsRefusedATolerance) {
  Problem problem = klein_gordon_case(0.0, 1.0);
  problem.friction = dry_friction(0.1);
  ASSERT_TRUE(promise_energy_law(problem, 10).promised);
  for (const MethodEntry& method : methods()) {
    if (!applies(method.name, problem)) continue;
    for (const double h : {1.0 / 16, 0.5, 2.5}) {
      Simulation simulation(problem, {.method = std::string(method.name)});
      EnergyReading before = simulation.energy();
      for (int n = 0; n < 40 && simulation.step(h).solved(); ++n) {
        const EnergyReading now = simulation.energy();
        EXPECT_LE(now.modified, before.modified + now.modified_round_off) << method.name << " h = " << h;
        before = now;
      }
    }
  }
  for (const char* method : {"auto", "seisav", "egc4"})
    EXPECT_THROW(Simulation(problem, {.method = method, .variable_steps = true, .tolerance = 1e-5}), Error) << method;
}

TEST(Friction, MethodsMeetTheToleranceUnderFrictionThatSaturates) {
  Problem problem = klein_gordon_case(0.0, 1.0);
  problem.friction = saturating_friction(0.1, 0.05);
  const Reference reference = make_reference(problem, std::vector{0.0, 2.0});
  for (const char* method : {"auto", "seavf", "egc4"}) {
    Simulation simulation(problem, {.method = method, .variable_steps = true, .tolerance = 1e-5});
    const RunReport report = integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                                                {.tolerance = 1e-5, .t_end = 2});
    ASSERT_EQ(report.status, RunReport::Status::success) << method << ": " << report.message;
    const Eigen::Map<const Vector> exact(reference.state(1).data(), problem.size());
    EXPECT_LE((simulation.physical() - exact).lpNorm<Eigen::Infinity>(), 1e-4) << method;
  }
}

TEST(Friction, FrictionThatIsNaNFailsTheStepAndLeavesTheState) {
  Problem problem = duffing_case();
  problem.friction = formula_friction(formula("0.3*v^1.5"), problem.grid);  // NaN where v < 0
  for (const char* method : {"egc6", "etdrk4", "seimp", "strang_exact", "seisav"}) {
    Simulation simulation(problem, {.method = method});
    StepReport report;
    for (int n = 0; n < 100 && report.solved(); ++n) report = simulation.step(1.0 / 16);
    EXPECT_FALSE(report.solved()) << method;
    EXPECT_TRUE(simulation.state().z.allFinite()) << method;
  }
}

TEST(Friction, WhatFeedsEnergyIsPromisedNoLawAndTheWitnessIsNamed) {
  for (const auto& [name, problem] : beyond_linear_cases()) {
    const LawPromise promise = promise_energy_law(problem, 10);
    const bool feeds = name == "van_der_Pol" || name.ends_with("forced");
    EXPECT_EQ(promise.promised, !feeds) << name << ": " << promise.reason;
    const Certificate certificate = certify(problem, {.method = "egc4", .t_end = 10});
    int violated = 0;
    for (const Hypothesis& h : certificate.hypotheses)
      if (h.grade == Grade::violated && (h.name == "v·R(v) ≥ 0" || h.name == "no external force")) {
        ++violated;
        EXPECT_NE(h.witness, "");
      }
    EXPECT_EQ(violated, feeds ? 1 : 0) << name;
  }
}

// Between two places that are looked at, and between decades.
TEST(Friction, FrictionThatFeedsEnergyInANarrowBandIsFound) {
  for (const char* r : {"v*(v-2)*(v-3)", "v*((v-1.25)^2-0.05)", "v*((v-0.25)^2-0.002)", "v*((v+0.85)^2-0.02)",
                        "v*((v-0.85)^2-0.015)"}) {
    Problem p = oscillator();
    p.friction = formula_friction(formula(r), p.grid);
    EXPECT_FALSE(promise_energy_law(p, 10).promised) << r;
  }
  Problem p = oscillator();
  p.friction = position_friction(formula("(u-3)^2-0.0001"), p.grid);
  EXPECT_FALSE(promise_energy_law(p, 10).promised);
  p.friction = position_friction(formula("(u-3)^2+0.0001"), p.grid);
  EXPECT_TRUE(promise_energy_law(p, 10).promised);
}

// Reversed van der Pol: c = 1 − u² feeds where |u| > 1, as one of the members does.
TEST(Friction, FrictionThatFeedsOneMemberOfAnEnsembleLeavesTheOthersTheirPromise) {
  Problem p = oscillator({.omega_squared = 4.0, .alpha = 0.0});
  p.friction = position_friction(formula("1 - u^2"), p.grid);
  const auto shared = std::make_shared<const Problem>(p);
  const auto at = [&](double u) { return EnsembleMember{shared, (Vector(2) << u, 0.0).finished()}; };
  for (const bool feeds_first : {true, false}) {
    const std::vector<EnsembleMember> members = {at(feeds_first ? 1.5 : 0.5), at(feeds_first ? 0.5 : 1.5), at(0.4)};
    const EnsembleResult result =
        run_ensemble(members, {.simulation = {.method = "seavf"},
                               .h = 1.0 / 64,
                               .t_end = 0.25,
                               .promise =
                                   [](const Simulation&) {
                                     return LawPromise{true, "to see who breaks it"};
                                   },
                               .objection = [](const Problem& q) { return q.friction->complaint(); }});
    for (std::size_t m = 0; m < members.size(); ++m) {
      const bool feeds = m == (feeds_first ? 0U : 1U);
      const RunReport& report = result.members[m].report;
      EXPECT_EQ(report.law, feeds ? LawVerdict::not_promised : LawVerdict::holds) << m;
      if (feeds) {
        EXPECT_NE(report.law_reason.find("feeds energy at t = "), std::string::npos) << report.law_reason;
      }
    }
    EXPECT_EQ(p.friction->fed_at(), "") << "each block of members remembers on its own";
  }
}

// 10v³ at v = 3 within h = 0.1: the step is taken in parts, and that must not be missed.
TEST(Friction, FrictionThatAStepDoesNotResolveIsSaid) {
  Problem p = oscillator({.alpha = 0.0, .gamma = constant_rate(0.0)});
  p.friction = cubic_friction(10);
  p.initial = Vector{{1, 3}};
  const Solution coarse = solve(p, {.method = "egc6", .h = 0.1, .t_end = 1});
  EXPECT_EQ(coarse.report.halved, 1);
  ASSERT_EQ(coarse.report.remarks().size(), 1U);
  EXPECT_THAT(coarse.report.remarks()[0], testing::HasSubstr("1 of 10 steps was taken in shorter parts"));
  EXPECT_THAT(coarse.report.message, testing::HasSubstr(coarse.report.remarks()[0]));
  EXPECT_TRUE(solve(p, {.method = "egc6", .h = 0.001, .t_end = 1}).report.remarks().empty());
}

}  // namespace TEST_FILE
}  // namespace seiche::test
