// Tolerances and the interval law where the linear part has no share in the error: gradient flows, and energies without
// a quadratic term.
#include <seiche/config/custom/custom_problem.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/simulation/solve.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace seiche {
namespace TEST_FILE {

struct Flow {
  std::string name;
  CustomProblem problem;
  std::function<Vector(double t)> exact;
};

std::vector<Flow> flows() {
  const FormulaTable dissipative = {{"-1", "0"}, {"0", "-1"}}, turning = {{"-0.5", "0"}, {"0", "-2"}};
  // ȧ = −a³: a(t) = a₀/√(1 + 2a₀²t)
  const auto cubic = [](double a, double rate, double t) { return a / std::sqrt(1 + 2 * rate * a * a * t); };
  std::vector<Flow> all;
  for (const auto& [S, first, second] : {std::tuple(dissipative, 1.0, 1.0), {turning, 0.5, 2.0}})
    all.push_back({fmt::format("quartic, S = diag(−{}, −{})", first, second),
                   {.fields = {"a", "b"}, .H = "a^4/4 + b^4/4", .S = S, .initial = {{"a", "1.5"}, {"b", "0.2"}}},
                   [cubic, first = first, second = second](double t) {
                     return Vector{{cubic(1.5, first, t), cubic(0.2, second, t)}};
                   }});
  // a little of a linear part must not hide what it has no share in
  all.push_back({"ȧ = −a³ − 10⁻⁴a",
                 {.fields = {"a", "b"},
                  .H = "a^4/4 + b^4/4 + (a^2 + b^2)/20000",
                  .S = dissipative,
                  .initial = {{"a", "1.5"}, {"b", "0"}}},
                 [](double t) {
                   const double k = 1e-4, e = std::exp(-2 * k * t);
                   return Vector{{1.5 * std::sqrt(e / (1 + 1.5 * 1.5 / k * (1 - e))), 0}};
                 }});
  return all;
}

TEST(Tolerance, HoldsWhereTheLinearPartHasNoShareInTheError) {
  constexpr double t_end = 3;
  for (const Flow& flow : flows()) {
    const Problem problem = custom_problem(flow.problem);
    const Vector exact = flow.exact(t_end);
    for (const char* method : {"egc2", "egc4", "egc6", "egc8"}) {
      for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
        const Solution s = solve(problem, {.method = method, .tolerance = tolerance, .t_end = t_end});
        ASSERT_TRUE(s.success()) << s.report.message;
        const Eigen::Map<const Vector> last(s.z.data() + s.z.size() - 2, 2);
        EXPECT_LE((last - exact).lpNorm<Eigen::Infinity>(), 10 * tolerance)
            << flow.name << ", " << method << ", " << tolerance << ": " << s.report.steps << " steps";
      }
    }
  }
}

// Where z goes straight down V, errors of the solution inside a step add up, and two quadratures on it agree on a wrong
// dissipation.
TEST(EnergyInterval, CostsNoAccuracyOnGradientFlows) {
  const Problem p = custom_problem({.fields = {"a", "b"},
                                    .H = "(a^2 + b^2 - 1)^2/4 + (a - b)^2/2",
                                    .S = {{"-1", "0"}, {"0", "-1"}},
                                    .initial = {{"a", "1.5"}, {"b", "0.2"}}});
  const auto end = [&](const std::string& method, double h, EnergyLaw law) {
    MethodOptions options;
    options.law = law;
    Simulation simulation(p, {.method = method, .method_options = options});
    for (int n = 0; n < static_cast<int>(3 / h); ++n) EXPECT_TRUE(simulation.step(h).solved());
    return Vector(simulation.physical());
  };
  const Vector exact = end("egc8", 1.0 / 128, EnergyLaw::none);
  for (const auto& [method, factor] :
       {std::pair("egc4", 2.0), {"egc6", 2.0}, {"egc8", 2.0}, {"etdrk4", 2.0}, {"egc2", 3.0}, {"seimp", 3.0}}) {
    for (const double h : {1.0 / 4, 1.0 / 8, 1.0 / 16}) {
      const auto error = [&, name = method](EnergyLaw law) { return (end(name, h, law) - exact).norm(); };
      EXPECT_LE(error(EnergyLaw::interval), factor * std::max(error(EnergyLaw::guard), 1e-13))
          << method << ", h = " << h;
    }
  }
}

}  // namespace TEST_FILE
}  // namespace seiche
