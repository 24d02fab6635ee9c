// Variable steps: the tolerance means what it says, the law holds at every accepted step, and asked times cost no
// steps.
#include <test/support/cases.hpp>
#include <test/support/convergence.hpp>
#include <test/support/written_problem.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/config/custom/custom_problem.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/formula/formula_compiler.hpp>
#include <seiche/law/law.hpp>
#include <seiche/loop/adaptive.hpp>
#include <seiche/loop/integrate.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/oscillator.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seiche::test {
namespace TEST_FILE {

// Asks for the times of a reference and compares; watches the energy of accepted steps.
class Judge final : public Observer {
 public:
  Judge(const Reference& reference, const Space& space) : reference_(reference), space_(space) {}
  bool is_due(const State&, bool) const override { return true; }
  double next_time() const override {
    return asked_ < reference_.count() ? reference_.time(asked_) : std::numeric_limits<double>::infinity();
  }
  void observe(const State& state, const EnergyReading& energy) override {
    if (asked_ < reference_.count() && state.t == reference_.time(asked_)) {
      const std::span<const double> exact = reference_.state(asked_++);
      const Vector distance =
          space_.physical(state.z) - Eigen::Map<const Vector>(exact.data(), static_cast<Index>(exact.size()));
      error = std::max(error, distance.lpNorm<Eigen::Infinity>());
      return;
    }
    const double round_off = std::max(energy.modified_round_off, last_.modified_round_off);
    if (steps++ > 0) worst_increase = std::max(worst_increase, (energy.modified - last_.modified) / round_off);
    last_ = energy;
  }
  void finish(const RunReport&) override {}
  bool saw_everything() const { return asked_ == reference_.count(); }

  double error = 0, worst_increase = -std::numeric_limits<double>::infinity();
  int steps = 0;

 private:
  const Reference& reference_;
  const Space& space_;
  std::size_t asked_ = 1;  // after t = 0
  EnergyReading last_;
};

// How far H and the modified energy part, where steps end and at times that are asked for.
class Parting final : public Observer {
 public:
  bool is_due(const State&, bool) const override { return true; }
  double next_time() const override { return 0.0625 * asked_; }
  void observe(const State& state, const EnergyReading& energy) override {
    const bool is_asked = state.t == next_time();
    double& most = is_asked ? between : at_steps;
    most = std::max(most, std::abs(energy.modified - energy.H));
    if (is_asked) ++asked_;
    rises += energy.modified > last_.modified + last_.modified_round_off ? 1 : 0;
    if (!is_asked) last_ = energy;
  }
  void finish(const RunReport&) override {}

  double between = 0, at_steps = 0;
  int rises = 0;

 private:
  int asked_ = 1;
  EnergyReading last_{.modified = std::numeric_limits<double>::infinity()};
};

struct Outcome {
  double error = 0;
  RunReport report;
};

Outcome run(const Problem& problem, const std::string& method, const Reference& reference, double tolerance) {
  Simulation simulation(problem, {.method = method, .variable_steps = true});
  Judge judge(reference, *simulation.system().space);
  const std::vector<Observer*> observers = {&judge};
  const double t_end = reference.time(reference.count() - 1);
  const RunReport report = integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                                              {.tolerance = tolerance, .t_end = t_end}, observers);
  EXPECT_EQ(report.status, RunReport::Status::success) << method << ": " << report.message;
  EXPECT_TRUE(judge.saw_everything()) << method;
  EXPECT_GE(judge.steps, report.steps) << method;
  if (promise_energy_law(problem, t_end).promised) {
    EXPECT_LE(judge.worst_increase, 1) << method;
  }
  return {judge.error, report};
}

std::vector<double> every_unit(double t_end) {
  std::vector<double> times;
  for (double t = 0; t <= t_end; ++t) times.push_back(t);
  return times;
}

const std::vector<NamedProblem>& four_problems() {
  static const std::vector<NamedProblem> list = {{"Duffing", duffing_case()},
                                                 {"KG", klein_gordon_case()},
                                                 {"FPU", fpu_conservative_case()},
                                                 {"gKdV", gkdv_case(0.5, 1.0)}};
  return list;
}

TEST(Adaptive, TheModifiedEnergyBetweenStepsBelongsToTheStateThere) {
  for (const std::string method : {"seisav", "ssav", "eisav"}) {
    Simulation simulation(klein_gordon_case(), {.method = method, .variable_steps = true});
    Parting parting;
    const std::vector<Observer*> observers = {&parting};
    const RunReport report = integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                                                {.tolerance = 1e-2, .t_end = 20}, observers);
    ASSERT_EQ(report.status, RunReport::Status::success) << report.message;
    EXPECT_GT(parting.between, 0.1 * parting.at_steps) << method;
    EXPECT_LE(parting.between, 1.5 * parting.at_steps) << method;
    EXPECT_EQ(parting.rises, 0) << method;
  }
}

TEST(AdaptiveSlow, TheToleranceOfCollocationIsTheErrorOverSixDecades) {
  for (const auto& [name, problem] : four_problems()) {
    const Reference reference = make_reference(problem, every_unit(50));
    for (const std::string method : {"egc4", "egc6", "egc8"}) {
      std::vector<double> tolerances, errors;
      for (int e = 4; e <= 9; ++e) {
        const double tolerance = std::pow(10.0, -e);
        const Outcome outcome = run(problem, method, reference, tolerance);
        EXPECT_LE(outcome.error, 10 * tolerance) << name << " " << method << " " << tolerance;
        EXPECT_GE(outcome.error, tolerance / 100) << name << " " << method << " " << tolerance;
        tolerances.push_back(tolerance);
        errors.push_back(outcome.error);
      }
      EXPECT_NEAR(fitted_order(tolerances, errors), 1, 0.15) << name << " " << method;
    }
  }
}

TEST(Adaptive, TheToleranceOfMethodsOfOrderTwoIsTheError) {
  for (const auto& [name, problem] : four_problems()) {
    const Reference reference = make_reference(problem, every_unit(20));
    for (const MethodEntry& method : methods()) {
      if (method.order > 2 || !applies(method.name, problem)) continue;
      for (const double tolerance : {1e-3, 1e-5}) {
        const Outcome outcome = run(problem, std::string(method.name), reference, tolerance);
        EXPECT_LE(outcome.error, 10 * tolerance) << name << " " << method.name << " " << tolerance;
        EXPECT_GE(outcome.error, tolerance / 200) << name << " " << method.name << " " << tolerance;
      }
    }
  }
}

TEST(Adaptive, TheToleranceOfOneStepMethodsOfHighOrderIsTheError) {
  for (const auto& [name, problem] : four_problems()) {
    const Reference reference = make_reference(problem, every_unit(20));
    for (const MethodEntry& method : methods()) {
      if (method.order <= 2 || method.kind.make_base == nullptr || !applies(method.name, problem)) continue;
      for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
        const Outcome outcome = run(problem, std::string(method.name), reference, tolerance);
        EXPECT_LE(outcome.error, 10 * tolerance) << name << " " << method.name << " " << tolerance;
        EXPECT_GE(outcome.error, tolerance / 1000) << name << " " << method.name << " " << tolerance;
      }
    }
  }
}

TEST(Adaptive, UndampedAndUnstableSolutionsStayWithinTwentyTolerances) {
  Problem well = oscillator({.omega_squared = -1.0, .gamma = nullptr});
  well.initial[0] = 0.3;
  const std::vector<NamedProblem> problems = {{"double well", well},
                                              {"undamped KG", klein_gordon_case(0.0, 1.0)},
                                              {"large gKdV", gkdv_case(0.5, 1.0, 1.0)}};
  for (const auto& [name, problem] : problems) {
    const Reference reference = make_reference(problem, every_unit(50));
    for (const std::string method : {"egc4", "egc8"})
      for (const double tolerance : {1e-4, 1e-6, 1e-8})
        EXPECT_LE(run(problem, method, reference, tolerance).error, 20 * tolerance) << name << " " << method;
  }
}

TEST(Adaptive, TimesThatAreAskedForChangeNoStep) {
  const Problem p = klein_gordon_case();
  const Reference reference = make_reference(p, every_unit(10));
  for (const std::string method : {"egc6", "seisav"}) {
    Simulation asked(p, {.method = method, .variable_steps = true});
    Simulation alone(p, {.method = method, .variable_steps = true});
    Judge judge(reference, *asked.system().space);
    const std::vector<Observer*> observers = {&judge};
    const AdaptiveOptions options{.tolerance = 1e-5, .t_end = 10, .first_h = 1.0 / 64};
    const RunReport a = integrate_adaptive(asked.system(), asked.adaptive_stepper(), asked.state(), options, observers);
    const RunReport b = integrate_adaptive(alone.system(), alone.adaptive_stepper(), alone.state(), options);
    EXPECT_EQ(a.steps, b.steps) << method;
    EXPECT_EQ(asked.state().z, alone.state().z) << method;
  }
}

// A pulse of damping far shorter than the steps that the waves allow.
TEST(Adaptive, ABoundOnStepsSeesWhatHappensInsideOne) {
  const Problem p = klein_gordon({.gamma = formula_rate(compile_formula("0.1 + 20*exp(-400*(t - 20.123)^2)", {"t"}))});
  const Reference reference = make_reference(p, every_unit(30));
  Simulation simulation(p, {.method = "egc6", .variable_steps = true});
  Judge judge(reference, *simulation.system().space);
  const std::vector<Observer*> observers = {&judge};
  integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                     {.tolerance = 1e-4, .t_end = 30, .largest_h = 0.05}, observers);
  EXPECT_LE(judge.error, 1e-3);
}

// H is flat at rest, and a projection on one of its values moves the state by √round-off there.
TEST(Adaptive, APendulumComesToRestAtItsTiltedPlaceWhateverTheTolerance) {
  const RunSpec spec = parse_case(
      "[problem]\nname = \"custom\"\nH = \"p^2/2 + 1 - cos(q) - q/10\"\nD = { p = 0.3 }\ninitial = { q = 0.5, p = 2 }\n"
      "[method]\nname = \"egc6\"\ntolerance = 1e-10\n[time]\nend = 150\n",
      "x.toml", {});
  const Problem problem = make_problem(spec);
  for (const char* method : {"egc4", "egc6", "egc8", "crkn6", "etdrk4"}) {
    for (const double tolerance : {1e-8, 1e-10, 1e-12}) {
      Simulation simulation(problem, {.method = method, .variable_steps = true});
      const RunReport report =
          integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                             {.tolerance = tolerance, .t_end = 150, .law = {true, "damped"}});
      ASSERT_EQ(report.status, RunReport::Status::success) << method << " " << tolerance << " " << report.message;
      EXPECT_EQ(report.law, LawVerdict::holds) << method << " " << report.law_reason;
      EXPECT_NEAR(simulation.physical()[0], std::asin(0.1), 1e-7) << method << " " << tolerance;
    }
  }
}

// The well is at q = 1, where H is flat: what round-off in H may move a state by excuses no error of the scheme, also
// where the oscillation has all but died out.
TEST(Adaptive, TheToleranceHoldsNearARestThatIsNotTheOrigin) {
  const Problem p = custom_problem(
      {.H = "p^2/2 - q^2/2 + q^4/4", .D = {{"0", "0"}, {"0", "0.1"}}, .initial = {{"q", "2"}, {"p", "0"}}});
  MethodOptions without_law;
  without_law.law = EnergyLaw::none;
  Simulation exact(p, {.method = "egc8", .method_options = without_law});
  integrate(exact.system(), exact.stepper(), exact.state(), {.h = 1.0 / 64, .t_end = 240});
  for (const char* method : {"egc4", "egc6", "crkn6"}) {
    const double tolerance = 1e-10;
    Simulation simulation(p, {.method = method, .variable_steps = true});
    const RunReport report = integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                                                {.tolerance = tolerance, .t_end = 240, .law = {true, "damped"}});
    ASSERT_EQ(report.status, RunReport::Status::success) << method << " " << report.message;
    EXPECT_LE((simulation.physical() - exact.physical()).lpNorm<Eigen::Infinity>(), 20 * tolerance) << method;
  }
}

// Each piece between jumps is smooth, and is integrated by itself with small steps.
Vector piecewise(const std::string& problem, double t_end, const std::vector<double>& jumps) {
  std::vector<double> ends = jumps;
  ends.push_back(t_end);
  const Problem p = make_problem(parse_case(problem, "x.toml"));
  Simulation simulation(p, {.method = "egc8"});
  double begin = 0;
  for (const double end : ends) {
    const int steps = 400;
    simulation.state().history_h = 0;
    for (int n = 0; n < steps; ++n) {
      EXPECT_TRUE(simulation.step((end - begin) / steps).solved());
      simulation.state().t = begin + (end - begin) * (n + 1) / steps;
    }
    begin = end;
  }
  return simulation.physical();
}

// Gauss' nodes may all lie on one side of a jump, so that only the integral of γ(t) or f(t) tells that there is one.
TEST(Adaptive, TheToleranceHoldsWhereRatesAndForcesJump) {
  const double pi = std::numbers::pi;
  const std::string duffing = "[problem]\nname = \"oscillator\"\nomega_squared = 1.0\nalpha = 1.0\n";
  for (const std::string drive : {"gamma = \"0.3 + 0.25*sign(sin(t))\"", "gamma = \"abs(sin(t))\"",
                                  "gamma = 0.1\nforce = \"0.5*sign(sin(t))\""}) {
    const Vector exact = piecewise(duffing + drive, 10, {pi, 2 * pi, 3 * pi});
    for (const std::string method : {"egc4", "egc6", "egc8", "etdrk4"}) {
      for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
        const Problem p = make_problem(parse_case(duffing + drive, "x.toml"));
        Simulation simulation(p, {.method = method, .variable_steps = true});
        const RunReport report = integrate_adaptive(simulation.system(), simulation.adaptive_stepper(),
                                                    simulation.state(), {.tolerance = tolerance, .t_end = 10});
        EXPECT_EQ(report.status, RunReport::Status::success) << drive << " " << method << ": " << report.message;
        const Vector distance = simulation.physical() - exact;
        EXPECT_LE(distance.lpNorm<Eigen::Infinity>(), 20 * tolerance) << drive << " " << method << " " << tolerance;
      }
    }
  }
}

// At rest round-off of the state is nothing, and sign(0) = 0 is what a formula gives at the one point of the start.
TEST(Adaptive, TheToleranceHoldsWhereAForceJumpsAtTheStartFromRest) {
  const double pi = std::numbers::pi;
  struct Case {
    std::string problem;
    std::vector<double> jumps;
  };
  const std::string custom = "[problem]\nname = \"custom\"\ninitial = \"zero\"\n";
  for (const Case& of : {Case{custom + "H = \"p^2/2 + 1 - cos(q)\"\nD = { p = 0.2 }\n"
                                       "force = { p = \"0.5*sign(sin(2*t))\" }",
                              {pi / 2, pi, 3 * pi / 2}},
                         Case{custom + "H = \"p^2/2 + q^2/2 + q^4/4\"\nD = { p = 0.1 }\n"
                                       "force = { p = \"exp(-t)*sign(t)\" }",
                              {}},
                         Case{custom + "fields = [\"a\", \"b\", \"p\", \"r\"]\n"
                                       "H = \"(p^2 + r^2)/2 + (a - b)^4/4 + a^2 + b^2/2\"\nD = { p = 0.3 }\n"
                                       "force = { r = \"0.2 + 0.4*sign(sin(3*t))\" }",
                              {pi / 3, 2 * pi / 3, pi, 4 * pi / 3}}}) {
    const Vector exact = piecewise(of.problem, 5, of.jumps);
    for (const std::string method : {"egc4", "egc6", "egc8", "etdrk4", "seisav", "seilm"}) {
      for (const double tolerance : {1e-4, 1e-7}) {
        if (tolerance < 1e-6 && method.starts_with("se")) continue;  // of order two
        const Problem p = make_problem(parse_case(of.problem, "x.toml"));
        Simulation simulation(p, {.method = method, .variable_steps = true});
        const RunReport report = integrate_adaptive(simulation.system(), simulation.adaptive_stepper(),
                                                    simulation.state(), {.tolerance = tolerance, .t_end = 5});
        EXPECT_EQ(report.status, RunReport::Status::success) << of.problem << " " << method << ": " << report.message;
        const Vector distance = simulation.physical() - exact;
        EXPECT_LE(distance.lpNorm<Eigen::Infinity>(), 20 * tolerance) << of.problem << " " << method;
      }
    }
  }
}

// What a friction that saturates does where a velocity turns falls between the nodes of a long step.
TEST(Adaptive, TheToleranceHoldsThroughLayersOfFriction) {
  struct Case {
    const char *V, *friction, *q, *method;
    double tolerance;
  };
  for (const Case& of :
       {Case{"q^2/2 + q^4/8", R"x(kind = "tanh", coefficient = 0.425, width = 0.02)x", "2.68", "egc8", 1e-8},
        Case{"q^2", R"x(kind = "tanh", coefficient = 0.6, width = 0.02)x", "2", "egc4", 1e-4},
        Case{"q^2", R"x(kind = "tanh", coefficient = 0.449, width = 0.0061)x", "1.9", "egc6", 1e-8},
        Case{"1 - cos(q)", R"x(kind = "tanh", coefficient = 0.3, width = 0.004)x", "2.5", "egc6", 1e-6},
        Case{"q^2/2", R"x(kind = "formula", r = "0.2*v*(1 + 40*exp(-(u/0.01)^2))")x", "1", "egc6", 1e-6}}) {
    const Problem problem =
        make_problem(read(fmt::format("H = \"p^2/2 + {}\"\nfriction = {{ {} }}\ninitial = {{ q = \"{}\", p = \"0\" }}",
                                      of.V, of.friction, of.q)));
    constexpr double t_end = 6;
    const auto end = [&](const char* method, double tolerance, double h_max) {
      Simulation simulation(problem, {.method = method, .variable_steps = true});
      const RunReport report =
          integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                             {.tolerance = tolerance, .t_end = t_end, .largest_h = h_max});
      EXPECT_EQ(report.status, RunReport::Status::success) << of.friction << ": " << report.message;
      return simulation.physical();
    };
    const Vector exact = end("etdrk4", 1e-10, 1e-3);
    const double error = (end(of.method, of.tolerance, 0) - exact).lpNorm<Eigen::Infinity>();
    EXPECT_LE(error, 10 * of.tolerance * t_end) << of.V << ", " << of.friction << ", " << of.method;
  }
}

TEST(Adaptive, AShortPulseOfARateIsSeen) {
  const std::string pulse =
      "[problem]\nname = \"oscillator\"\nomega_squared = 1.0\nalpha = 1.0\ngamma = \"40*exp(-((t - 7.77)/0.01)^2)\"";
  const Vector exact = piecewise(pulse, 10, {7.5, 7.7, 7.77, 7.84, 8});
  for (const std::string method : {"egc4", "egc6", "egc8"}) {
    const Problem p = make_problem(parse_case(pulse, "x.toml"));
    Simulation simulation(p, {.method = method, .variable_steps = true});
    integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                       {.tolerance = 1e-6, .t_end = 10});
    const Vector distance = simulation.physical() - exact;
    EXPECT_LE(distance.lpNorm<Eigen::Infinity>(), 2e-5) << method;
  }
}

// Without V there are no forces, and the φ-maps of the error estimate have no columns.
TEST(Adaptive, LinearEquationsTakeATolerance) {
  for (const NamedProblem& linear :
       {NamedProblem{"wave", klein_gordon({.alpha = 0.0})},
        NamedProblem{"dirichlet",
                     klein_gordon({.grid = {.points = {16}, .length = {2.0}, .boundary = {Boundary::dirichlet}},
                     .alpha = 0.0})}}) {
    for (const std::string method : {"egc2", "egc4", "egc6", "egc8"})
      for (const std::string backend : {"modal", "dense", "sparse"}) {
        Problem p = linear.problem;
        p.potential = nullptr;
        Simulation simulation(p, {.method = method, .backend = backend, .variable_steps = true});
        const std::vector<double> asked = every_unit(3);
        const Reference reference = make_reference(p, asked);
        Judge judge(reference, *simulation.system().space);
        const std::vector<Observer*> observers = {&judge};
        const RunReport report = integrate_adaptive(simulation.system(), simulation.adaptive_stepper(),
                                                    simulation.state(), {.tolerance = 1e-6, .t_end = 3}, observers);
        EXPECT_EQ(report.status, RunReport::Status::success) << linear.name << " " << method << " " << report.message;
        EXPECT_LE(judge.error, 1e-9) << linear.name << " " << method << " " << backend;
      }
  }
}

TEST(Adaptive, AToleranceIsMeasuredByTheStateItIsAbout) {
  Problem small = oscillator({.alpha = 0.0});
  small.initial *= 1e-9;
  Simulation simulation(small, {.method = "egc4", .variable_steps = true});
  const auto run_with = [&](double tolerance) {
    simulation.restart();
    return integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(),
                              {.tolerance = tolerance, .t_end = 1})
        .message;
  };
  EXPECT_NE(run_with(1e-6).find("is more than the largest number of the initial state, 1e-09"), std::string::npos);
  EXPECT_EQ(run_with(1e-12).find("more than"), std::string::npos);
  EXPECT_THROW(run_with(1e-24), Error);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
