// The energy law as an option, and the methods that need it.
#include <test/support/cases.hpp>
#include <test/support/convergence.hpp>
#include <test/support/falling_energy.hpp>
#include <test/support/matrices.hpp>
#include <test/support/worst.hpp>

#include <seiche/config/custom/custom_problem.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/method/splitting/nystrom_scheme.hpp>
#include <seiche/problem/chain.hpp>
#include <seiche/problem/sine_gordon.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace seiche::test {
namespace TEST_FILE {

using ::testing::AllOf;
using ::testing::HasSubstr;

MethodOptions with_law(EnergyLaw law) {
  MethodOptions options;
  options.law = law;
  return options;
}

MethodOptions with_explicit_kicks() {
  MethodOptions options;
  options.linear = LinearTreatment::explicit_kicks;
  return options;
}

double largest_rise(const Problem& problem, const std::string& method, EnergyLaw law, double h, int steps) {
  Simulation simulation(problem, {.method = method, .method_options = with_law(law)});
  double rise = -std::numeric_limits<double>::infinity();
  double before = simulation.energy().H;
  for (int n = 0; n < steps; ++n) {
    EXPECT_TRUE(simulation.step(h).solved()) << method;
    const double after = simulation.energy().H;
    rise = worse(rise, after - before);
    before = after;
  }
  return rise;
}

// Without damping H is to stay: a scheme alone lets it rise now and then.
TEST(Projected, TheLawIsThatOfTheProjectionAndNotOfTheSchemeUnderIt) {
  Problem p = klein_gordon_case(0.0, 1.0);
  p.initial *= 3;
  for (const MethodEntry& method : methods()) {
    if (!method.projects()) continue;
    const std::string name(method.name);
    for (const EnergyLaw law : {EnergyLaw::interval, EnergyLaw::guard}) {
      if (law < method.projection) continue;
      EXPECT_LE(largest_rise(p, name, law, 0.25, 400), 1e-12) << name << to_string(law);
    }
    if (method.kind.composition == "chin") continue;  // keeps H without the law too
    EXPECT_GT(largest_rise(p, name, EnergyLaw::none, 0.25, 400), 1e-9) << name;
  }
}

TEST(Projected, TheGuardKeepsTheOrderAndLetsHFallAtEveryStepSize) {
  Problem p = klein_gordon_case(0.1, 1.0);
  p.initial *= 4;
  const std::vector<double> h = {1.0 / 32, 1.0 / 64, 1.0 / 128, 1.0 / 256};
  const Reference reference = make_reference(p, sample_times(h, 10.0));
  for (const MethodEntry& method : methods()) {
    if (!method.projects() || method.order > 4) continue;
    const std::string name(method.name);
    std::vector<double> errors;
    for (const double step : h)
      errors.push_back(
          errors_against(reference, p, {.method = name, .method_options = with_law(EnergyLaw::guard)}, step).solution);
    EXPECT_NEAR(fitted_order(h, errors), method.order, 0.3) << name << "\n" << table(h, errors);
    for (const double step : {1.0 / 64, 1.0, 10.0, 25.0})
      EXPECT_LE(largest_rise(p, name, EnergyLaw::guard, step, 100), 1e-13) << name << " " << step;
  }
}

// There forces are states, and the damping that the exponential has not is among them.
TEST(Projected, ARungeKuttaSchemeHasItsOrderWithDampingThatVaries) {
  const std::vector<double> h = {1.0 / 16, 1.0 / 32, 1.0 / 64, 1.0 / 128};
  int seen = 0;
  for (const auto& [name, problem] : all_cases()) {
    if (name.find("varying") == std::string::npos && name.find("field_rate") == std::string::npos) continue;
    ++seen;
    const Reference reference = make_reference(problem, sample_times(h, 10.0));
    std::vector<double> errors;
    for (const double step : h)
      errors.push_back(errors_against(reference, problem, {.method = "etdrk4"}, step).solution);
    EXPECT_NEAR(fitted_order(h, errors), 4, 0.3) << name << "\n" << table(h, errors);
  }
  EXPECT_EQ(seen, 8);
}

std::string refusal(const Problem& problem, const std::string& method, const MethodOptions& options = {}) {
  try {
    Simulation simulation(problem, {.method = method, .method_options = options});
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Projected, WhatAMethodCannotDoIsRefusedWithTheReason) {
  const Problem kg = klein_gordon_case();
  EXPECT_THAT(refusal(kg, "seisav", with_law(EnergyLaw::guard)), AllOf(HasSubstr("seisav"), HasSubstr("projection")));
  EXPECT_THAT(refusal(kg, "strang_exact", with_law(EnergyLaw::interval)),
              AllOf(HasSubstr("guard"), HasSubstr("inside")));
  EXPECT_THAT(refusal(kg, "egc4", with_explicit_kicks()), HasSubstr("crkn4"));
  EXPECT_EQ(refusal(kg, "crkn4", with_explicit_kicks()), "accepted");

  for (const std::string method : {"crkn4", "crkn6", "chin4"}) {
    EXPECT_THAT(refusal(gkdv_case(), method), AllOf(HasSubstr(method + " does not apply"), HasSubstr("etdrk4")));
    for (const auto& [name, problem] : field_rate_cases())
      EXPECT_THAT(refusal(problem, method), HasSubstr("does not apply")) << name;
  }
  Problem both = kg;
  both.damping.rate_fields = {true, true};
  EXPECT_THAT(refusal(both, "crkn4"), HasSubstr("momenta alone"));
  const Problem friction = chain({.points = 6, .neighbour_cubic = 0.5, .neighbour_damping = 0.3});
  EXPECT_EQ(refusal(friction, "crkn4"), "accepted");
  EXPECT_THAT(refusal(friction, "crkn4", with_explicit_kicks()), HasSubstr("one number"));
  EXPECT_THAT(refusal(friction, "chin4"), HasSubstr("one number"));
}

// What needs momenta runs where there are some, so that no problem falls away quadrature_error.
TEST(Projected, NystromSplittingsApplyToEveryProblemWithConstantDampingOfMomenta) {
  for (const auto& [name, problem] : all_cases()) {
    const bool one_field = problem.field_count() == 1;
    const bool varies = name.find("varying") != std::string::npos || name.find("field_rate") != std::string::npos ||
                        name == "KG_without_V";
    const bool couples = name.starts_with("NLS") || name.starts_with("coupled");
    const bool beyond_linear = problem.friction || problem.has_forces() || problem.structure;
    EXPECT_EQ(applies("crkn4", problem), !one_field && !varies && !couples && !beyond_linear) << name;
    EXPECT_EQ(applies("crkn6", problem), applies("crkn4", problem)) << name;
  }
}

// e^{b_m hB} e^{a_{m−1} hA} … e^{b₀hB} against e^{h(A+B)}, for matrices with B² = 0 as a kick has, and any A.
TEST(Nystrom, TheCoefficientsMeetTheConditionsOfTheirOrder) {
  constexpr Index n = 6;
  Matrix A(n, n);
  Matrix B = Matrix::Zero(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      A(i, j) = std::sin(3.0 * static_cast<double>(i) + 1.7 * static_cast<double>(j) + 1);
      if (i >= n / 2 && j < n / 2) B(i, j) = std::cos(static_cast<double>(2 * i - j));
    }
  for (const int order : {4, 6}) {
    const NystromScheme& scheme = nystrom_scheme(order);
    ASSERT_EQ(scheme.b.size(), scheme.flows() + 1);
    for (std::size_t i = 0; i < scheme.flows(); ++i) EXPECT_EQ(scheme.a[i], scheme.a[scheme.flows() - 1 - i]);
    for (std::size_t i = 0; i <= scheme.flows(); ++i) EXPECT_EQ(scheme.b[i], scheme.b[scheme.flows() - i]);
    // With c_i the time of a kick: Σ b_i c_iᵏ = 1/(k + 1), as for any quadrature of that order. With d_i the sum of the
    // kicks before a flow: Σ a_i d_i² = 1/3.
    for (int k = 0; k < order; ++k) {
      double sum = 0;
      double c = 0;
      for (std::size_t i = 0; i <= scheme.flows(); ++i) {
        sum += scheme.b[i] * std::pow(c, k);
        if (i < scheme.flows()) c += scheme.a[i];
      }
      EXPECT_NEAR(sum, 1.0 / (k + 1), 2e-14) << order << " " << k;
    }
    double squares = 0;
    double d = 0;
    for (std::size_t i = 0; i < scheme.flows(); ++i) {
      d += scheme.b[i];
      squares += scheme.a[i] * d * d;
    }
    EXPECT_NEAR(squares, 1.0 / 3, 2e-14) << order;

    std::vector<double> h, errors;
    for (double step = order == 4 ? 0.1 : 0.3; h.size() < 4; step /= 1.5) {
      Matrix product = exponential_by_extended_series(scheme.b[0] * step * B);
      for (std::size_t i = 0; i < scheme.flows(); ++i)
        product = exponential_by_extended_series(scheme.b[i + 1] * step * B) *
                  exponential_by_extended_series(scheme.a[i] * step * A) * product;
      h.push_back(step);
      errors.push_back((product - exponential_by_extended_series(step * (A + B))).norm());
    }
    EXPECT_NEAR(fitted_order(h, errors), order + 1, 0.3) << table(h, errors);
  }
  EXPECT_THROW(nystrom_scheme(8), Error);
}

TEST(Nystrom, ExplicitKicksHaveTheOrderAndTheLawToo) {
  Problem kg = klein_gordon_case(0.1, 1.0);
  kg.initial *= 4;
  Problem duffing = duffing_case();
  duffing.initial *= 2;
  const std::vector<NamedProblem> problems = {{"KG", kg}, {"Duffing", duffing}, {"undamped", duffing_case(0)}};
  for (const auto& [name, problem] : problems) {
    for (const std::string method : {"crkn4", "crkn6"}) {
      const int order = find_method(method).order;
      std::vector<double> h;
      for (double step = order == 4 ? 1.0 / 16 : 1.0 / 8; h.size() < 4; step /= 2)
        h.insert(h.end(), {step, 5 * step / 7});
      const Reference reference = make_reference(problem, sample_times(h, 10.0));
      const MethodOptions options = with_explicit_kicks();
      for (const BackendEntry& backend : backends_for(problem)) {
        std::vector<double> errors;
        for (const double step : h)
          errors.push_back(
              errors_against(reference, problem,
                             {.method = method, .backend = std::string(backend.name), .method_options = options}, step)
                  .solution);
        EXPECT_NEAR(fitted_order(h, errors), order, 0.3) << name << " " << method << " " << backend.name << "\n"
                                                         << table(h, errors);
      }
      for (const double step :
           {1.0 / 64, 0.25, 1.0, 10.0}) {  // unstable from somewhere on, and the law holds all the same
        Simulation simulation(problem, {.method = method, .method_options = options});
        expect_falling_energy(simulation, step, 200, name + " " + method);
      }
    }
  }
}

TEST(Chin, LetsHFallByItsFormAlone) {
  Problem p = klein_gordon_case(0.5, 1.0);
  p.initial *= 3;
  for (const double h : {1.0 / 16, 0.5, 1.0}) {
    Simulation simulation(p, {.method = "chin4", .method_options = with_law(EnergyLaw::none)});
    expect_falling_energy(simulation, h, 200);
  }
}

// b oscillates by itself and V knows nothing of it.
TEST(Chin, TakesAPotentialThatLeavesOutAPosition) {
  const Problem p =
      custom_problem({.fields = {"a", "b", "p", "r"},
                      .H = "(p^2 + r^2)/2 + a^2/2 + b^2 + a*b/2 + a^4/4",
                      .D = {{"0", "0", "0", "0"}, {"0", "0", "0", "0"}, {"0", "0", "0.1", "0"}, {"0", "0", "0", "0.1"}},
                      .initial = {{"a", "1"}, {"b", "0.5"}, {"p", "0.25"}, {"r", "0"}}});
  const auto end = [&](const std::string& method, int steps, const MethodOptions& options = {}) {
    Simulation simulation(p, {.method = method, .method_options = options});
    for (int n = 0; n < steps; ++n) EXPECT_TRUE(simulation.step(4.0 / steps).solved());
    return Vector(simulation.physical());
  };
  const Vector exact = end("egc8", 256);
  EXPECT_LT((end("chin4", 64) - exact).norm(), 1e-6);
  EXPECT_LT((end("crkn6", 64, with_explicit_kicks()) - exact).norm(), 1e-8);
}

TEST(Chin, CountsWhatItsInnerProjectionsFallBackTo) {
  Problem p = sine_gordon({.grid = {.points = {40}, .length = {20.0}}, .gamma = constant_rate(0.05)});
  const auto fallbacks = [&](double h) {
    Simulation simulation(p, {.method = "chin4"});
    int count = 0;
    for (int n = 0; n < 25; ++n) {
      const StepReport report = simulation.step(h);
      EXPECT_TRUE(report.solved()) << report.message;
      count += report.fallbacks;
    }
    return count;
  };
  EXPECT_EQ(fallbacks(1.0 / 16), 0);
  EXPECT_GT(fallbacks(8.0), 5);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
