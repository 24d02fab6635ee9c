// Every method shows the order it declares, on every problem it applies to.
#include <test/support/cases.hpp>
#include <test/support/convergence.hpp>

#include <seiche/damping/rates.hpp>
#include <seiche/problem/alpha_fpu.hpp>
#include <seiche/problem/gkdv.hpp>
#include <seiche/problem/nls.hpp>
#include <seiche/simulation/simulation.hpp>

#include <gtest/gtest.h>

#include <map>

namespace seiche::test {
namespace TEST_FILE {

const std::vector<double> step_sizes = {1.0 / 32, 1.0 / 64, 1.0 / 128, 1.0 / 256};

std::vector<double> errors_of(const Reference& reference, const Problem& problem, const SimulationOptions& options,
                              const std::vector<double>& h) {
  std::vector<double> list;
  for (const double step : h) {
    const Errors errors = errors_against(reference, problem, options, step);
    EXPECT_EQ(errors.failure, "");
    EXPECT_EQ(errors.unresolved, 0);
    list.push_back(errors.solution);
  }
  return list;
}

// Steps in which damping is so weak that the energy interval does not give way to it (energy_interval.hpp), where the
// constant of the error is another one.
std::vector<double> weak_steps(const Problem& problem, const MethodEntry& method) {
  const Simulation simulation(problem, {.method = std::string(method.name)});
  const Vector& z = simulation.state().z;
  const double rate =
      simulation.system().damping->largest_rate(*simulation.system().space, 0, 10, z, Vector::Zero(z.size()));
  std::vector<double> weak = step_sizes;
  while (rate * weak.front() > 0.01)
    for (double& h : weak) h /= 2;
  return weak;
}

TEST(OrderSlow, OfEveryMethodOfOrderTwoIsTwoOnEveryProblem) {
  for (const auto& [name, problem] : all_cases()) {
    std::map<double, Reference> references;  // by the longest step
    for (const MethodEntry& method : methods()) {
      if (!applies(method.name, problem) || method.order > 2) continue;
      const std::vector<double> h = method.projects() ? weak_steps(problem, method) : step_sizes;
      if (!references.contains(h.front()))
        references.emplace(h.front(), make_reference(problem, sample_times(h, 10.0)));
      const Reference& reference = references.at(h.front());
      const std::vector<double> errors = errors_of(reference, problem, {.method = std::string(method.name)}, h);
      const double tolerance = method.kind.takes_solver ? 0.3 : 0.1;
      EXPECT_NEAR(fitted_order(h, errors), method.order, tolerance) << name << " " << method.name << "\n"
                                                                    << table(h, errors);
    }
  }
}

// The four shortest steps of a ladder whose errors still stand clear of round-off.
TEST(Order, OfEveryMethodOfHighOrderIsTheOneItDeclares) {
  // large amplitudes, so that even order eight has errors to show at steps where its order is seen
  Problem klein_gordon = klein_gordon_case(0.1, 1.0);
  klein_gordon.initial *= 4;
  Problem duffing = duffing_case();
  duffing.initial *= 2;
  const Problem fpu = alpha_fpu({.points = 8, .exponent = 2, .epsilon = 4000.0, .gamma = constant_rate(0.1)});
  const std::vector<NamedProblem> problems = {{"KG", klein_gordon},
                                              {"FPU", fpu},
                                              {"gKdV", gkdv_case(0.5, 1.0)},
                                              {"Duffing", duffing},
                                              {"NLS", nls({.grid = {.points = {32}, .length = {12.0}}, .kappa = -1})}};
  for (const auto& [name, problem] : problems) {
    std::vector<double> ladder;
    for (double h = 0.5; h > 1.0 / 70; h /= 2) ladder.insert(ladder.end(), {h, 5 * h / 7});
    const Reference reference = make_reference(problem, sample_times(ladder, 10.0));
    for (const MethodEntry& method : methods()) {
      if (method.order <= 2 || !applies(method.name, problem)) continue;
      const double round_off = method.kind.takes_linear ? 3e-12 : 1e-12;  // up to eleven flows a step
      std::vector<double> h;
      std::vector<double> errors;
      for (const double step : ladder) {
        const double error = errors_of(reference, problem, {.method = std::string(method.name)}, {step}).front();
        if (error < round_off) break;
        h.push_back(step);
        errors.push_back(error);
      }
      ASSERT_GE(h.size(), 4) << name << " " << method.name;
      h.erase(h.begin(), h.end() - 4);
      errors.erase(errors.begin(), errors.end() - 4);
      EXPECT_NEAR(fitted_order(h, errors), method.order, 0.3) << name << " " << method.name << "\n" << table(h, errors);
    }
  }
}

TEST(Order, IsTwoWithRefreshedAuxiliaryAndWithDampingThatVariesInTime) {
  Problem p = klein_gordon_case();
  class Wave final : public Rate {  // γ(t) = 0.4 + 0.3 sin(3t)
   public:
    double value(double t) const override { return 0.4 + 0.3 * std::sin(3 * t); }
    double integral(double t, double h) const override {
      return 0.4 * h - 0.1 * (std::cos(3 * (t + h)) - std::cos(3 * t));
    }
    bool is_constant() const override { return false; }
    double first_negative_time(double) const override { return -1; }
    double negative_seen() const override { return -1; }
    std::string text() const override { return "0.4 + 0.3*sin(3*t)"; }
  };
  p.damping.rate = std::make_shared<Wave>();
  const Reference varying = make_reference(p, sample_times(step_sizes, 10.0));
  for (const std::string method : {"savf", "ssav", "slm", "seavf", "seisav", "seilm", "seidm"}) {
    const std::vector<double> errors = errors_of(varying, p, {.method = method}, step_sizes);
    EXPECT_NEAR(fitted_order(step_sizes, errors), 2.0, find_method(method).kind.takes_solver ? 0.3 : 0.1)
        << method << table(step_sizes, errors);
  }

  const Problem strong = gkdv_case(0.5, 1.0, 1.0);
  const Reference reference = make_reference(strong, sample_times(step_sizes, 10.0));
  for (const std::string method : {"ssav", "seisav"})
    for (const AuxiliaryMode mode : {AuxiliaryMode::refresh, AuxiliaryMode::relaxed}) {
      SimulationOptions options{.method = method};
      options.method_options.auxiliary = mode;
      const std::vector<double> errors = errors_of(reference, strong, options, step_sizes);
      EXPECT_NEAR(fitted_order(step_sizes, errors), 2.0, 0.1) << method << table(step_sizes, errors);
    }
}

TEST(Order, TheFrozenAuxiliaryOfThePrintedSchemesDoesNotConvergeWhereDampingTouchesV) {
  const Problem p = gkdv_case(0.5, 1.0, 1.0);
  const Reference reference = make_reference(p, sample_times(step_sizes, 10.0));
  SimulationOptions sav{.method = "seisav"};
  sav.method_options = {.C = 2.0, .auxiliary = AuxiliaryMode::frozen};
  const std::vector<double> sav_errors = errors_of(reference, p, sav, step_sizes);
  EXPECT_LT(fitted_order(step_sizes, sav_errors), 0.1) << table(step_sizes, sav_errors);
  EXPECT_NEAR(sav_errors.back(), 1.62e-2, 0.02e-2);

  SimulationOptions lm{.method = "seilm"};
  lm.method_options = {.C = {}, .auxiliary = AuxiliaryMode::frozen, .scalar_solver = ScalarSolver::newton};
  for (const double h : step_sizes) {
    const Errors errors = errors_against(reference, p, lm, h);
    EXPECT_TRUE(errors.solution > 1 || !errors.failure.empty()) << h << " " << errors.solution;
  }
}

TEST(Order, OfTheRobustMultiplierIsTwoOnWeaklyDampedGkdvWithEveryStepResolved) {
  const Problem p = gkdv_case(0.1);
  const std::vector<double> h = {1.0 / 64, 1.0 / 128, 1.0 / 256, 1.0 / 512};
  const Reference reference = make_reference(p, sample_times(h, 50.0));
  const std::vector<double> errors = errors_of(reference, p, {.method = "seilm"}, h);
  EXPECT_NEAR(fitted_order(h, errors), 2.0, 0.1) << table(h, errors);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
