// method = "auto": what it sees, and what it takes.
#include <test/support/cases.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/damping/frictions.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/loop/adaptive.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/truss.hpp>
#include <seiche/problem/variable_wave.hpp>
#include <seiche/simulation/auto_method.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/study/reference.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace seiche::test {
namespace TEST_FILE {

TEST(AutoMethod, RatesAreThoseOfTheLinearPartAndOfTheSolution) {
  const Problem wave = klein_gordon({.grid = {.points = {64}, .length = {6.4}}, .kappa = 1.0, .omega_squared = 4.0});
  for (const char* backend : {"dense", "modal", "sparse"}) {
    Problem p = wave;
    p.potential = nullptr;
    for (Index j = 0; j < 64; ++j) p.initial[j] = 1;  // the mean alone: it turns with ω = 2
    p.initial.tail(64).setZero();
    const ProblemRates rates = rates_of(find_backend(backend).system(p, {}));
    EXPECT_NEAR(rates.linear, std::sqrt(4 + 4 / 0.01), 0.1 * std::sqrt(404)) << backend;
    EXPECT_EQ(rates.damping, 0) << backend;
    EXPECT_NEAR(rates.solution, 2, 1e-4) << backend;
  }
}

TEST(AutoMethod, EveryProblemRunsAndReachesItsTolerance) {
  for (const auto& [name, problem] : all_cases()) {
    const double tolerance = 1e-6;
    Simulation simulation(problem, {.method = "auto", .variable_steps = true, .tolerance = tolerance});
    EXPECT_NE(simulation.reason(), "") << name;
    const RunReport report = integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                                                {.tolerance = tolerance, .t_end = 2.0});
    ASSERT_EQ(report.status, RunReport::Status::success) << name << ": " << report.message;
    const Reference reference = make_reference(problem, std::vector{0.0, 2.0});
    const Vector z = simulation.physical();
    double error = 0;
    for (Index i = 0; i < z.size(); ++i)
      error = std::max(error, std::abs(z[i] - reference.state(1)[static_cast<std::size_t>(i)]));
    EXPECT_LE(error, 20 * tolerance) << name << " by " << simulation.method().name;
  }
}

TEST(AutoMethod, ARateThatIsNotANumberIsNotWritten) {
  const Problem p =
      make_problem(parse_case("[problem]\nname = \"custom\"\nH = \"p^2/2 + sqrt(q)\"\nD = { p = \"0.1\" }\n"
                              "initial = { q = \"1e-7\", p = \"0\" }\n",
                              "x.toml"));
  const Simulation simulation(p, {.method = "auto", .variable_steps = true, .tolerance = 1e-6});
  EXPECT_EQ(simulation.reason().find("nan"), std::string::npos) << simulation.reason();
  EXPECT_EQ(simulation.reason().find("stiff"), std::string::npos) << simulation.reason();
  EXPECT_NE(simulation.reason().find("not finite close to the start"), std::string::npos) << simulation.reason();
}

TEST(AutoMethod, TakesCollocationWhereFrictionTurnsNoFasterThanTheSolution) {
  Problem p = klein_gordon_case(0.0, 1.0);
  p.friction = saturating_friction(0.4, 1.0);
  EXPECT_EQ(Simulation(p, {.method = "auto", .variable_steps = true, .tolerance = 1e-7}).method().name, "egc6");
  p.friction = saturating_friction(0.4, 1e-4);
  EXPECT_EQ(Simulation(p, {.method = "auto", .variable_steps = true, .tolerance = 1e-7}).method().name, "seisav");
}

TEST(AutoMethod, TakesExactFlowsWhereFrictionIsSharp) {
  Problem p = klein_gordon_case(0.0, 1.0);
  p.friction = dry_friction(0.1);
  const Simulation simulation(p, {.method = "auto"});
  EXPECT_EQ(simulation.method().name, "seisav");
  EXPECT_NE(simulation.reason().find("sgn"), std::string::npos) << simulation.reason();
}

TEST(AutoMethod, KicksWhereMatricesWouldMakeExactFlowsKrylovSpaces) {
  const SimulationOptions options{.method = "auto", .variable_steps = true, .tolerance = 1e-6, .duration = 1000};
  const Problem membrane = variable_wave(
      {.grid = {.points = {16, 16}, .length = {2.0, 2.0}, .boundary = {Boundary::dirichlet, Boundary::dirichlet}},
       .alpha = 1.0,
       .gamma = constant_rate(0.1)});
  const Simulation kicked(membrane, options);
  EXPECT_EQ(kicked.backend().name, "sparse");
  EXPECT_EQ(kicked.method_options().linear, LinearTreatment::explicit_kicks) << kicked.reason();
  EXPECT_NE(kicked.reason().find("Krylov"), std::string::npos) << kicked.reason();

  SimulationOptions of_one_size = options;  // which may be beyond what is stable
  of_one_size.variable_steps = false;
  of_one_size.tolerance = 0;
  EXPECT_EQ(Simulation(membrane, of_one_size).method_options().linear, LinearTreatment::exact);

  // Dashpots between the masses are no multiple of the momenta.
  const Simulation damped(truss({.panels = 12, .dashpot = 0.2}), options);
  EXPECT_EQ(damped.backend().name, "sparse");
  EXPECT_EQ(damped.method_options().linear, LinearTreatment::exact) << damped.reason();
}

TEST(AutoMethod, KeepsStiffDampingOutOfBackwardFlows) {
  EXPECT_EQ(Simulation(fpu_conservative_case(0.5, 0.01), {.method = "auto", .tolerance = 1e-6}).method().name, "crkn4");
  const Simulation stiff(fpu_conservative_case(0.5, 10.0), {.method = "auto", .tolerance = 1e-6});
  EXPECT_EQ(stiff.method().kind.composition, "collocation") << stiff.reason();
}

struct Wave {
  double length, tolerance, t_end;
  Index points = 256;
  double gamma = 0.1;
};

std::unique_ptr<Simulation> chosen_for(const Wave& wave, const std::string& backend = "auto") {
  Problem p = klein_gordon(
      {.grid = {.points = {wave.points}, .length = {wave.length}}, .alpha = 1.0, .gamma = constant_rate(wave.gamma)});
  for (Index j = 0; j < wave.points; ++j)
    p.initial[j] = std::cos(2 * std::numbers::pi * p.grid.coordinate(j, 0) / wave.length);
  p.initial.tail(wave.points).setZero();
  SimulationOptions options{.method = "auto", .backend = backend};
  options.variable_steps = wave.tolerance > 0;
  options.tolerance = wave.tolerance;
  options.duration = wave.t_end;
  return std::make_unique<Simulation>(p, options);
}

TEST(AutoMethod, KicksByAllForcesWhereNothingIsStiffOrFaded) {
  const auto slow = chosen_for({.length = 50, .tolerance = 1e-6, .t_end = 20});
  EXPECT_EQ(slow->method_options().linear, LinearTreatment::explicit_kicks) << slow->reason();
  EXPECT_EQ(slow->backend().name, "sparse");
  EXPECT_EQ(chosen_for({.length = 50, .tolerance = 1e-6, .t_end = 1e6, .gamma = 0})->backend().name, "sparse");
  const std::vector<Wave> others = {
      {.length = 0.5, .tolerance = 1e-6, .t_end = 20},               // stiff
      {.length = 50, .tolerance = 0, .t_end = 20},                   // steps of one size
      {.length = 50, .tolerance = 1e-6, .t_end = 1e4},               // over long before
      {.length = 50, .tolerance = 1e-6, .t_end = 0},                 // who knows
      {.length = 50, .tolerance = 1e-6, .t_end = 20, .points = 60},  // few unknowns
  };
  for (const Wave& wave : others) {
    const auto simulation = chosen_for(wave);
    EXPECT_EQ(simulation->method_options().linear, LinearTreatment::exact) << simulation->reason();
    EXPECT_EQ(simulation->backend().name, "modal");
  }
  const auto asked = chosen_for({.length = 50, .tolerance = 1e-6, .t_end = 20}, "modal");
  EXPECT_EQ(asked->backend().name, "modal");
  EXPECT_EQ(asked->method_options().linear, LinearTreatment::exact);
}

TEST(AutoMethod, TakesHigherOrdersForSmallerTolerances) {
  int last = 0;
  for (const double tolerance : {1e-2, 1e-6, 1e-10}) {
    const Simulation simulation(gkdv_case(), {.method = "auto", .tolerance = tolerance});
    EXPECT_GE(simulation.method().order, last);
    last = simulation.method().order;
  }
  EXPECT_EQ(last, 8);
}

TEST(AutoMethod, TakesTheCaseThatAnotherMethodWouldTake) {
  for (const std::string& text : {example_case("klein_gordon"), write_case(parse_case(example_case("gkdv"), "x.toml"))})
    EXPECT_EQ(parse_case(text, "y.toml", {"method.name=auto"}).method, "auto");
}

TEST(AutoMethod, ACaseSaysWhatWasChosenAndWhy) {
  RunSpec spec =
      parse_case("[problem]\nname = \"klein_gordon\"\n[method]\nname = \"auto\"\ntolerance = 1e-7\n", "x.toml");
  EXPECT_EQ(spec.method, "auto");
  settle_method(spec);
  EXPECT_NE(spec.method, "auto");
  ASSERT_EQ(spec.notes.size(), 1U);
  EXPECT_NE(spec.notes[0].find(spec.method), std::string::npos) << spec.notes[0];
  EXPECT_EQ(parse_case(write_case(spec), "y.toml").method, spec.method);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
