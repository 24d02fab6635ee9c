// Steps that do not resolve the linear flow: what its quadrature misses is known, and the law does no harm there.
#include <test/support/cases.hpp>

#include <seiche/backend/backends.hpp>
#include <seiche/config/custom/custom_problem.hpp>
#include <seiche/core/numerics/quadrature.hpp>
#include <seiche/method/projection/flow_quadrature.hpp>
#include <seiche/simulation/solve.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

using testing::HasSubstr;

// Momenta alone: ṗ = −γp + n, ∫γp² in closed form.
TEST(FlowQuadrature, MissesWhatTheClosedFormSays) {
  const GaussRule rule(3);
  for (const double gamma : {0.5, 30.0, 1e4, 1e8}) {
    const Problem problem = custom_problem({.H = "p^2/2",
                                            .D = {{"0", "0"}, {"0", fmt::format("{:.17g}", gamma)}},
                                            .initial = {{"q", "0.2"}, {"p", "0.7"}}});
    for (const BackendEntry& backend : backends_for(problem)) {
      if (backend.name == "sparse" && gamma > 1e4) continue;  // refused: a step would take a million Krylov substeps
      const System system = backend.system(problem, {});
      const auto phi = system.make_phi();
      FlowQuadrature quadrature(system, *phi, PhiRows::Forces::states, rule.nodes, rule.weights);
      for (const double force : {0.0, 5.0}) {
        constexpr double h = 0.1;
        Vector n(system.initial.size());
        system.space->from_physical(Vector{{0, force}}, n);
        const double rest = force / gamma, away = 0.7 - rest;  // p = rest + away e^{−γt}
        const double integral = gamma * rest * rest * h - 2 * rest * away * std::expm1(-gamma * h) -
                                away * away / 2 * std::expm1(-2 * gamma * h);
        double sum = 0;
        for (Index i = 0; i < 3; ++i)
          sum += h * rule.weights[i] * gamma * std::pow(rest + away * std::exp(-gamma * h * rule.nodes[i]), 2);
        EXPECT_NEAR(quadrature.miss(h, system.initial, n, 0), sum - integral, 1e-12 * (sum + integral))
            << backend.name << " " << gamma << " " << force;
      }
    }
  }
}

// Blocks that are real, complex, and complex and of size two, of steps up to many periods: no quadrature of a few nodes
// follows these.
TEST(FlowQuadrature, IsTheSameOnEveryBackend) {
  const std::vector<CustomProblem> problems = {
      {.grid = GridOptions{.points = {8}, .length = {0.5}},
       .H = "v^2/2 + u_x^2/2 + u^4/4",
       .D = {{"0", "0"}, {"0", "0.3"}},
       .initial = {{"u", "exp(sin(4*pi*x))"}, {"v", "cos(12*pi*x)"}}},
      {.fields = {"u"},
       .grid = GridOptions{.points = {12}, .length = {1}},
       .H = "u_x^2/2 - u^3/6",
       .S = {{"d_x"}},
       .D = {{"0.5"}},
       .initial = {{"u", "exp(sin(2*pi*x))"}}},
      {.fields = {"a", "b"},
       .grid = GridOptions{.points = {12}, .length = {1}},
       .H = "(a_x^2 + b_x^2)/2 + a^2 + a^4/4",
       .S = {{"d_x", "1"}, {"-1", "d_x"}},
       .D = {{"0.5", "0"}, {"0", "0.5"}},
       .initial = {{"a", "exp(sin(2*pi*x))"}, {"b", "cos(4*pi*x)"}}},
  };
  const GaussRule rule(4);
  for (const CustomProblem& custom : problems) {
    const Problem problem = custom_problem(custom);
    for (const double h : {0.1, 1.0}) {
      std::vector<double> missed;
      for (const BackendEntry& backend : backends_for(problem)) {
        const System system = backend.system(problem, {});
        const auto phi = system.make_phi();
        Vector n(system.initial.size()), gradient = Vector::Zero(n.size());
        system.potential->gradient(system.initial, gradient);
        system.linear->apply_S(gradient, n);
        for (const bool as_gradient : {true, false}) {
          const auto kind = as_gradient ? PhiRows::Forces::gradients : PhiRows::Forces::states;
          FlowQuadrature quadrature(system, *phi, kind, rule.nodes, rule.weights);
          missed.push_back(quadrature.miss(h, system.initial, as_gradient ? gradient : n, 0));
        }
      }
      ASSERT_GE(missed.size(), 6U);
      for (const double miss : missed)
        EXPECT_NEAR(miss, missed[0], 1e-8 * std::abs(missed[0]) + 1e-11) << custom.H << ", " << h;
      EXPECT_GT(std::abs(missed[0]), h == 1 ? 1e-3 : 1e-7) << custom.H;
    }
  }
}

// The sum of several forces is what the flow is under, and rates come from above.
TEST(FlowQuadrature, SeveralForcesAreOneAndRatesAreBounds) {
  const Problem problem = custom_problem({.grid = GridOptions{.points = {8}, .length = {0.5}},
                                          .H = "v^2/2 + u_x^2/2 + u^4/4",
                                          .D = {{"0", "0"}, {"0", "0.3"}},
                                          .initial = {{"u", "exp(sin(4*pi*x))"}, {"v", "cos(12*pi*x)"}}});
  const double fastest = 4 / 0.0625 / 2;  // 2/dx
  for (const BackendEntry& backend : backends_for(problem)) {
    const System system = backend.system(problem, {});
    const auto phi = system.make_phi();
    EXPECT_GE(phi->rate(), fastest * (1 - 1e-6)) << backend.name;
    EXPECT_LE(phi->rate(), 1.5 * fastest) << backend.name;
    const auto error = [&](const std::vector<Vector>& forces) {
      const Index count = static_cast<Index>(forces.size());
      const PhiRow row{0.5, std::vector<double>(forces.size(), 0.5)};
      const PhiEvaluator::Form form{
          .rows = {.rows = {row}, .forces = count, .order = 1, .kind = PhiRows::Forces::states},
          .coefficients = {0.1},
          .minus_integral = true};
      double value = 0;
      phi->forms({&form, 1}, 0.1)->apply(system.initial, forces, {&value, 1});
      return value;
    };
    const Vector a = 3 * system.initial, b = -2 * system.initial;
    EXPECT_NEAR(error({a, b}), error({a + b}), 1e-10 * std::abs(error({a}))) << backend.name;
    EXPECT_GT(std::abs(error({a}) - error({b})), 1e-3 * std::abs(error({a}))) << backend.name;
  }
}

using RightHandSide = std::function<Vector(const Vector& z)>;

// The classical Runge–Kutta scheme with steps that resolve everything.
Vector reference(const RightHandSide& f, Vector z, double t_end, int steps) {
  const double h = t_end / steps;
  for (int n = 0; n < steps; ++n) {
    const Vector k1 = f(z), k2 = f(z + h / 2 * k1), k3 = f(z + h / 2 * k2), k4 = f(z + h * k3);
    z += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return z;
}

struct Unresolved {
  std::string name;
  CustomProblem problem;
  double h;
  RightHandSide f;
};

std::vector<Unresolved> unresolved_systems() {
  std::vector<Unresolved> systems;
  for (const double p : {0.3, 1.0, 0.0})
    systems.push_back({fmt::format("layer of friction, p = {}", p),
                       {.H = "p^2/2 + q^2/2 + q^4/4",
                        .D = {{"0", "0"}, {"0", "1000"}},
                        .initial = {{"q", "1"}, {"p", fmt::format("{}", p)}}},
                       0.1,
                       [](const Vector& z) {
                         return Vector{{z[1], -1000 * z[1] - z[0] - std::pow(z[0], 3)}};
                       }});
  systems.push_back({"layer that the force begins",
                     {.H = "p^2/2 + q^4/4", .D = {{"0", "0"}, {"0", "50"}}, .initial = {{"q", "1"}, {"p", "0"}}},
                     0.25,
                     [](const Vector& z) {
                       return Vector{{z[1], -50 * z[1] - std::pow(z[0], 3)}};
                     }});
  systems.push_back({"fast mode beside a slow one",
                     {.fields = {"q", "a", "p", "r"},
                      .H = "(p^2 + r^2)/2 + q^2/2 + 10000*a^2/2 + q^4/4",
                      .D = {{"0", "0", "0", "0"}, {"0", "0", "0", "0"}, {"0", "0", "1", "0"}, {"0", "0", "0", "1"}},
                      .initial = {{"q", "1"}, {"a", "0.01"}, {"p", "0"}, {"r", "0"}}},
                     0.25,
                     [](const Vector& z) {
                       return Vector{{z[2], z[3], -z[2] - z[0] - std::pow(z[0], 3), -z[3] - 1e4 * z[1]}};
                     }});
  return systems;
}

TEST(EnergyInterval, CostsNoAccuracyWhereStepsDoNotResolveTheLinearFlow) {
  constexpr double t_end = 2;
  int widened = 0;
  for (const Unresolved& of : unresolved_systems()) {
    const Problem problem = custom_problem(of.problem);
    const Vector exact = reference(of.f, problem.initial, t_end, 40000);
    for (const char* method : {"egc2", "egc4", "egc6", "egc8", "etdrk4", "seimp"}) {
      for (const char* backend : {"dense", "sparse"}) {
        const auto error = [&](std::optional<EnergyLaw> law) {
          SolveOptions o{.method = method, .backend = backend, .h = of.h, .t_end = t_end};
          o.method_options.law = law;
          const Solution s = solve(problem, o);
          EXPECT_TRUE(s.success()) << s.report.message;
          if (!law) {
            EXPECT_EQ(s.report.law, LawVerdict::holds) << s.report.law_reason;
            EXPECT_EQ(s.report.widened > 0, testing::Value(s.report.message, HasSubstr("does not resolve a layer")));
            widened += s.report.widened > 0 ? 1 : 0;
          }
          const Eigen::Map<const Vector> last(s.z.data() + s.z.size() - static_cast<std::size_t>(s.size), s.size);
          return (last - exact).lpNorm<Eigen::Infinity>();
        };
        const double best = std::min(error(EnergyLaw::guard), error(EnergyLaw::none));
        EXPECT_LE(error({}), 2 * best + 1e-10) << of.name << ", " << method << ", " << backend;
      }
    }
  }
  EXPECT_GT(widened, 30) << "of 60";
}

TEST(EnergyInterval, IsNotWidenedWhereStepsResolveTheFlow) {
  for (const auto& [name, problem] : golden_cases()) {
    for (const char* method : {"egc4", "egc6", "etdrk4"}) {
      const Solution s = solve(problem, {.method = method, .h = 1.0 / 64, .t_end = 2});
      EXPECT_EQ(s.report.widened, 0) << name << ", " << method;
    }
  }
}

// Cahn and Hilliard's equation, by steps so long that nothing but a constant is left, whose energy is larger: S∇H there
// is round-off.
TEST(EnergyIntervalSlow, NoStepIsLetRiseByTheRoundOffOfItsDissipation) {
  const Problem problem = custom_problem({.fields = {"u"},
                                          .grid = GridOptions{.points = {16}},
                                          .H = "0.004*u_x^2/2 + (u^2 - 1)^2/4",
                                          .S = {{"laplacian"}},
                                          .initial = {{"u", "0.6*cos(2*pi*x) + 0.2*sin(4*pi*x)"}}});
  for (const char* backend : {"dense", "modal", "sparse"}) {
    const bool is_sparse = backend == std::string("sparse");  // half a minute at h = 300
    for (const double h : is_sparse ? std::vector{1.0, 37.5} : std::vector{1.0, 37.5, 300.0}) {
      const Solution s = solve(problem, {.method = "strang_exact", .backend = backend, .h = h, .t_end = 4 * h});
      EXPECT_NE(s.report.law, LawVerdict::violated) << backend << ", h = " << h << ": " << s.report.law_reason;
      for (std::size_t n = 1; n < s.H.size(); ++n)
        EXPECT_LE(s.H[n], s.H[n - 1] * (1 + 1e-12)) << backend << ", h = " << h;
    }
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
