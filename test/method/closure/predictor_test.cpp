// The midpoint that closures predict from the gradients of the last steps, beside the paper's.
#include <test/support/cases.hpp>
#include <test/support/convergence.hpp>
#include <test/support/written_problem.hpp>

#include <gtest/gtest.h>
#include <seiche/damping/rates.hpp>
#include <seiche/loop/integrate.hpp>
#include <seiche/method/closure/midpoint_predictor.hpp>
#include <seiche/problem/gradient_flow/phase_separation.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/simulation/simulation.hpp>

#include <cmath>
#include <numbers>

namespace seiche::test {
namespace TEST_FILE {

const std::vector<std::string> closures = {"seisav", "seilm", "seidm", "seavf"};

SimulationOptions by(const std::string& method, Predictor predictor, const std::string& backend = "auto") {
  return {.method = method, .backend = backend, .method_options = {.C = {}, .predictor = predictor}};
}

double gradients_per_step(const Problem& problem, Predictor predictor) {
  Simulation simulation(problem, by("seisav", predictor));
  constexpr int start = 4, steps = 100;
  for (int n = 0; n < start; ++n) simulation.step(1.0 / 64);
  const auto before = simulation.system().potential->counts().gradients;
  for (int n = 0; n < steps; ++n) simulation.step(1.0 / 64);
  return static_cast<double>(simulation.system().potential->counts().gradients - before) / steps;
}

TEST(Predictor, RememberedTakesOneGradientAStepWhereThePapersTakesTwo) {
  for (const auto& [name, problem] : golden_cases()) {
    EXPECT_EQ(gradients_per_step(problem, Predictor::remembered), 1) << name;
    EXPECT_EQ(gradients_per_step(problem, Predictor::gradient), 2) << name;
  }
}

// Within 15 %, but for a few at steps of 1/4 and two by seilm at 1/16, whose errors are twice the others.
TEST(PredictorSlow, BothLeaveErrorsOfOneSizeOnEveryProblem) {
  const std::vector<double> step_sizes = {1.0 / 4, 1.0 / 16, 1.0 / 64};
  int compared = 0, alike = 0, no_better = 0;
  for (const auto& [name, problem] : all_cases()) {
    const Reference reference = make_reference(problem, sample_times(step_sizes, 10.0));
    for (const std::string& method : closures) {
      if (!applies(method, problem)) continue;
      for (const double h : step_sizes) {
        const Errors paper = errors_against(reference, problem, by(method, Predictor::gradient), h);
        const Errors ours = errors_against(reference, problem, by(method, Predictor::remembered), h);
        ASSERT_EQ(paper.failure + ours.failure, "") << name << " " << method;
        EXPECT_LT(ours.solution, 2.5 * paper.solution + 1e-12) << name << " " << method << " h = " << h;
        ++compared;
        if (ours.solution <= 1.15 * paper.solution + 1e-12) ++alike;
        if (paper.solution <= 1.15 * ours.solution + 1e-12) ++no_better;
      }
    }
  }
  RecordProperty("compared", compared);
  RecordProperty("alike", alike);
  EXPECT_GT(alike, 0.95 * compared) << alike << " of " << compared;
  EXPECT_GT(no_better, 0.5 * compared) << no_better << " of " << compared;  // else it should be the paper's
}

TEST(Predictor, KeepsTheLawAtEveryStepSize) {
  for (const auto& [name, problem] : golden_cases()) {
    for (const double h : {1.0 / 64, 1.0 / 16, 0.25, 1.0, 3.0, 10.0, 25.0, 300.0}) {
      Simulation simulation(problem, by("seisav", Predictor::remembered));
      double last = simulation.energy().modified;
      for (int n = 0; n < 60; ++n) {
        ASSERT_TRUE(simulation.step(h).solved()) << name << " h = " << h;
        const EnergyReading energy = simulation.energy();
        EXPECT_LE(energy.modified, last + 4 * energy.modified_round_off) << name << " h = " << h << " step " << n;
        last = energy.modified;
      }
    }
  }
}

// The guard is for steps that do not resolve the solution.
TEST(Predictor, IsGuardedInAHundredthOfTheStepsThatResolveTheSolution) {
  for (const auto& [name, problem] : golden_cases()) {
    for (const std::string& method : closures) {
      if (!applies(method, problem)) continue;
      for (const double h : {1.0 / 32, 1.0 / 64}) {
        Simulation simulation(problem, by(method, Predictor::remembered));
        int guarded = 0, steps = 0;
        for (; simulation.state().t < 10 - h / 2; ++steps) {
          ASSERT_TRUE(simulation.step(h).solved()) << name << " " << method;
          guarded += simulation.state().midpoints.resting > 0 ? 1 : 0;
        }
        EXPECT_LE(100 * guarded, steps) << name << " " << method << ", h = " << h;
      }
    }
  }
}

// α = 25: without the guard the memory feeds on itself, and the run overflows.
TEST(Predictor, TakesTheGradientWhereTheMemoryPredictsBadly) {
  const Problem problem = klein_gordon_case(0.1, 25.0);
  const std::vector<double> step_sizes = {0.5, 1.0, 2.0};
  for (const double h : step_sizes) {
    const Reference reference = make_reference(problem, sample_times(std::vector{h}, 20.0));
    const double paper = errors_against(reference, problem, by("seisav", Predictor::gradient), h).solution;
    const double ours = errors_against(reference, problem, by("seisav", Predictor::remembered), h).solution;
    EXPECT_LT(ours, 1.15 * paper) << "h = " << h;
  }
}

// The guard compares with what a step moves, which no translation changes.
TEST(Predictor, IsTheSameWhereTheWholeProblemIsTranslated) {
  struct Case {
    std::string H, rest;
    std::vector<std::string> fields;
    double shift;  // of the first field
  };
  const double pi = std::numbers::pi;
  const std::vector<Case> cases = {
      {"12*(1 - cos(q))", "S = [[\"-1\"]]", {"q"}, 40 * pi},
      {"p^2/2 + 30*(1 - cos(q))", "D = { p = 0.5 }", {"q", "p"}, 400 * pi},
      {"9*(1 - cos(q - a)) + 5*(1 - cos(q + a))", "S = [[\"-1\", \"0\"], [\"0\", \"-1\"]]", {"q", "a"}, 80 * pi},
      {"0.01*q_x^2/2 + 10*(1 - cos(q))",
       "points = [16]\nlength = [1]\nboundary = \"periodic\"\nS = [[\"-1\"]]",
       {"q"},
       60 * pi},
  };
  for (const Case& of : cases) {
    const bool on_grid = of.rest.find("points") != std::string::npos;
    const auto end = [&](double shift, const std::string& method, double h) {
      std::string text = "fields = [";
      for (const std::string& field : of.fields) text += "\"" + field + "\", ";
      text += "]\nH = \"" + of.H + "\"\n" + of.rest + "\ninitial = { q = \"" + fmt::format("{:.17g}", shift) +
              (on_grid ? " + 2.5 + 0.3*sin(2*pi*x)" : " + 2.5") + "\"";
      for (std::size_t f = 1; f < of.fields.size(); ++f) text += ", " + of.fields[f] + " = \"0.4\"";
      const Problem problem = make_problem(read(text + " }"));
      Simulation simulation(problem, by(method, Predictor::remembered));
      for (double t = 0; t < 3 - h / 2; t += h) EXPECT_TRUE(simulation.step(h).solved()) << of.H << " " << method;
      Vector z = simulation.physical();
      z.head(problem.grid.unknowns()).array() -= shift;
      return z;
    };
    for (const std::string& method : closures) {
      for (const double h : {1.0 / 8, 1.0 / 16, 1.0 / 64}) {
        const Vector here = end(0, method, h), there = end(of.shift, method, h);
        EXPECT_LE((here - there).lpNorm<Eigen::Infinity>(), 1e-9) << of.H << " " << method << ", h = " << h;
      }
    }
  }
}

// Where nothing is fused, a bound may stand for what was missed.
TEST(Predictor, OfEveryBackendIsTheSame) {
  for (const auto& [name, problem] : all_cases()) {
    if (!applies("seisav", problem)) continue;
    std::vector<Vector> ends;
    for (const BackendEntry& backend : backends_for(problem)) {
      Simulation simulation(problem, by("seisav", Predictor::remembered, std::string(backend.name)));
      for (int n = 0; n < 12; ++n) ASSERT_TRUE(simulation.step(1.0 / 16).solved()) << name;
      ends.push_back(simulation.physical());
    }
    for (const Vector& z : ends)
      EXPECT_LT((z - ends.front()).cwiseAbs().maxCoeff(), 1e-11 * (1 + ends.front().cwiseAbs().maxCoeff())) << name;
  }
}

// On dense the bound fails in a few of these steps, and a product says that all is well.
TEST(Predictor, IsThatOfOtherBackendsWhereABoundOfWhatItMissedIsTooRough) {
  for (const auto& [points, h] : {std::pair<Index, double>(20, 0.25), std::pair<Index, double>(8, 0.5)}) {
    const Problem problem = klein_gordon({.grid = {.points = {points}, .length = {0.1 * static_cast<double>(points)}},
                                          .kappa = 0.04,
                                          .omega_squared = 0.2,
                                          .alpha = 30.0,
                                          .gamma = constant_rate(0.1)});
    Simulation dense(problem, by("seisav", Predictor::remembered, "dense"));
    Simulation modal(problem, by("seisav", Predictor::remembered, "modal"));
    for (int n = 0; n < 60; ++n) {
      ASSERT_TRUE(dense.step(h).solved() && modal.step(h).solved());
      ASSERT_LT((dense.physical() - modal.physical()).cwiseAbs().maxCoeff(), 1e-11) << points << " points, step " << n;
    }
  }
}

// At steps so long that what the memory missed is moved by t²SMS, and not by tS alone.
TEST(Predictor, OfEveryBackendIsGuardedAtTheSameLongSteps) {
  const std::vector<NamedProblem> waves = {
      {"KG", klein_gordon_case()},
      {"free",
       klein_gordon({.grid = {.points = {16}, .length = {2.0}, .boundary = {Boundary::neumann}}, .alpha = 1.0})},
      {"Duffing", duffing_case(0.1)}};
  for (const auto& [name, problem] : waves) {
    for (const double h : {2.5, 24.0}) {
      std::vector<std::int64_t> gradients;
      for (const BackendEntry& backend : backends_for(problem)) {
        Simulation simulation(problem, by("seisav", Predictor::remembered, std::string(backend.name)));
        for (int n = 0; n < 5; ++n) ASSERT_TRUE(simulation.step(h).solved()) << name;
        gradients.push_back(simulation.system().potential->counts().gradients);
        EXPECT_EQ(gradients.back(), gradients.front()) << name << " " << backend.name << " h = " << h;
      }
    }
  }
}

// What a step keeps for the next one of its length belongs to that length: 0 too, and in any order.
TEST(Predictor, StepsOfAnyLengthsInAnyOrderAreThoseOfNewSteppers) {
  for (const NamedProblem& c : golden_cases()) {
    Simulation one(c.problem, by("seisav", Predictor::gradient));
    const Vector start = one.physical();
    one.step(0);
    EXPECT_LE((one.physical() - start).lpNorm<Eigen::Infinity>(), 1e-14) << c.name;
    for (const double h : {0.1, 0.05, 0.1, 0.0, -0.05, 0.1}) {
      Simulation other(c.problem, by("seisav", Predictor::gradient));
      other.state() = one.state();
      one.step(h);
      other.step(h);
      EXPECT_EQ(one.state().z, other.state().z) << c.name << " " << h;
    }
  }
}

TEST(Predictor, StartsAnewWithTheRun) {
  Simulation simulation(klein_gordon_case(), by("seisav", Predictor::remembered));
  Vector first;
  for (const bool again : {false, true}) {
    simulation.restart();
    for (int n = 0; n < 8; ++n) simulation.step(1.0 / 16);
    if (again) {
      EXPECT_EQ(simulation.physical(), first);
    } else {
      first = simulation.physical();
    }
    EXPECT_EQ(simulation.state().midpoints.known, MidpointMemory::depth);
  }
}

// Steps that change their size, as behind an estimate of errors: order two all the same.
TEST(Predictor, IsOfOrderTwoWhereStepsChangeTheirSize) {
  const Problem problem = klein_gordon_case(0.1, 1.0);
  Simulation exact(problem, {.method = "egc8"});
  integrate(exact.system(), exact.stepper(), exact.state(), {.h = 1.0 / 64, .t_end = 6.0});
  std::vector<double> h, errors;
  for (double step = 1.0 / 8; step > 1.0 / 100; step /= 2) {
    Simulation simulation(problem, by("seisav", Predictor::remembered));
    int n = 0;
    while (simulation.state().t < 6.0 - 1e-9)
      simulation.step(std::min(6.0 - simulation.state().t, ++n % 3 == 0 ? step / 2 : step));
    h.push_back(step);
    errors.push_back((simulation.physical() - exact.physical()).cwiseAbs().maxCoeff());
  }
  EXPECT_NEAR(fitted_order(h, errors), 2, 0.1) << table(h, errors);
}

// Where it is too far off, the guard takes the gradient at the start of the step instead (MidpointPredictor).
TEST(Predictor, RememberedIsNoWorseThanTheGradientOnGradientFlowsAtAnyStep) {
  const Problem flow =
      cahn_hilliard({.grid = {.points = {24, 24}, .length = {24.0}, .discretisation = Discretisation::spectral},
                     .kappa = 2,
                     .mobility = 5,
                     .barrier = 5,
                     .low = 0.3,
                     .high = 0.7,
                     .mean = 0.5,
                     .amplitude = 0.05});
  const auto end = [&](const SimulationOptions& options, double h) {
    Simulation simulation(flow, options);
    for (int n = 0; n < static_cast<int>(std::lround(32 / h)); ++n) EXPECT_TRUE(simulation.step(h).solved());
    return Vector(simulation.physical());
  };
  const Vector exact = end({.method = "egc6"}, 1.0 / 32);
  for (const char* method : {"seisav", "seilm"})
    for (const double h : {1.0 / 32, 1.0 / 16, 1.0 / 8, 1.0 / 4, 1.0 / 2, 1.0, 2.0, 4.0}) {
      const auto error = [&](Predictor p) { return (end(by(method, p), h) - exact).lpNorm<Eigen::Infinity>(); };
      EXPECT_LE(error(Predictor::remembered), 1.2 * error(Predictor::gradient)) << method << " " << h;
    }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
