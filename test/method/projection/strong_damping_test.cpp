// The default law is no worse than the guard or no law where damping is strong in one step, whatever else is not
// resolved there.
#include <test/support/written_problem.hpp>

#include <seiche/simulation/solve.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

struct Strong {
  std::string name, text;
  double t_end;
  std::vector<std::string> methods;
  std::vector<double> h;
};

// Infinite where the run gave no solution.
Vector end_of(const Solution& s) {
  if (!s.success()) return Vector::Constant(s.size, std::numeric_limits<double>::infinity());
  return s.last();
}

MethodOptions with_law(std::optional<EnergyLaw> law) {
  MethodOptions options;
  options.law = law;
  return options;
}

// The errors of the default law are at most twice the smaller one of the guard and of no law, as far as that keeps H
// from rising by a thousandth of what it was, beside `rounding` of the reference.
void expect_no_worse(const Strong& of, int& compared) {
  constexpr double rounding = 2e-11, resolved = 0.02, rise = 1e-3;
  const Problem problem = make_problem(read(of.text));
  const auto solved = [&](const std::string& method, double h, std::optional<EnergyLaw> law) {
    return solve(problem, {.method = method, .method_options = with_law(law), .h = h, .t_end = of.t_end});
  };
  const Vector exact = end_of(solved("egc8", 1.0 / 1024, EnergyLaw::none));
  for (const std::string& method : of.methods) {
    for (const double h : of.h) {
      const auto error = [&](const Solution& s) { return (end_of(s) - exact).lpNorm<Eigen::Infinity>(); };
      const Solution free = solved(method, h, EnergyLaw::none);
      double best = error(solved(method, h, EnergyLaw::guard));
      if (free.report.energy.max_increase <= rise * free.H.front()) best = std::min(best, error(free));
      if (!(best < resolved)) continue;
      ++compared;
      EXPECT_LE(error(solved(method, h, {})), 2 * best + rounding) << of.name << ", " << method << ", h = " << h;
    }
  }
}

const std::vector<std::string> one_mass = {"crkn4", "crkn6", "egc4", "egc6", "etdrk4", "seimp"};
const std::vector<std::string> without_kicks = {"egc2", "egc4", "egc6", "egc8", "etdrk4", "seimp"};

TEST(StrongDamping, OfMomentaIsNoReasonToMoveH) {
  int compared = 0;
  for (const Strong& of : std::vector<Strong>{{"pendulum in a spring",
                                               R"toml(fields = ["q", "p"]
H = "p^2/2 + 1 - cos(q) + q^2/2"
D = { p = 400 }
initial = { q = "1.5", p = "2" })toml",
                                               10,
                                               one_mass,
                                               {1.0 / 10, 1.0 / 40, 1.0 / 160}},
                                              {"quartic well",
                                               R"toml(fields = ["q", "p"]
H = "p^2/2 + q^2/2 + q^4/4"
D = { p = 150 }
initial = { q = "1", p = "-3" })toml",
                                               4,
                                               one_mass,
                                               {1.0 / 8, 1.0 / 32, 1.0 / 128}},
                                              {"one mass damped beside another",
                                               R"toml(fields = ["a", "b", "p", "r"]
H = "(p^2 + r^2)/2 + (a - b)^4/4 + a^2/2 + b^2/2"
D = { p = 500, r = 0.05 }
initial = { a = "1", b = "-0.5", p = "1", r = "0.3" })toml",
                                               10,
                                               one_mass,
                                               {1.0 / 40, 1.0 / 160}},
                                              {"soft coupling",
                                               R"toml(fields = ["a", "b", "p", "r"]
H = "(p^2 + r^2)/2 + log(cosh(a - b)) + a^2/2 + b^2/2"
D = { p = 60, r = 0.2 }
initial = { a = "0.5", b = "1.5", p = "2", r = "-1" })toml",
                                               5,
                                               one_mass,
                                               {1.0 / 20, 1.0 / 80}}})
    expect_no_worse(of, compared);
  EXPECT_GT(compared, 45);
}

TEST(StrongDamping, LeavesHWhereAStiffOscillationStandsInThePotential) {
  int compared = 0;
  for (const Strong& of : std::vector<Strong>{{"cosh",
                                               R"toml(fields = ["a", "b", "p", "r"]
H = "(p^2 + r^2)/2 + b^2/2 + 1e4*(cosh(a) - 1) + a*b^2/2"
D = { p = 20, r = 0.1 }
initial = { a = "0.05", b = "1", p = "0", r = "0" })toml",
                                               6,
                                               one_mass,
                                               {1.0 / 40, 1.0 / 160}},
                                              {"exponential spring",
                                               R"toml(fields = ["a", "b", "p", "r"]
H = "(p^2 + r^2)/2 + b^2/2 + 4e3*(exp(a) - 1 - a) + a*b^2/2"
D = { p = 12, r = 0.2 }
initial = { a = "0.03", b = "1", p = "0", r = "0.5" })toml",
                                               5,
                                               one_mass,
                                               {1.0 / 32, 1.0 / 64, 1.0 / 128}},
                                              {"steep pendulum",
                                               R"toml(fields = ["a", "b", "p", "r"]
H = "(p^2 + r^2)/2 + b^2/2 + 900*(1 - cos(3*a)) + 0.3*a^2*b^2"
D = { p = 15, r = 0.1 }
initial = { a = "0.1", b = "1", p = "0", r = "0" })toml",
                                               4,
                                               one_mass,
                                               {1.0 / 50, 1.0 / 100, 1.0 / 200}}})
    expect_no_worse(of, compared);
  EXPECT_GT(compared, 30);
}

TEST(StrongDamping, ByFrictionIsNoReasonEither) {
  int compared = 0;
  for (const Strong& of : std::vector<Strong>{{"cubic",
                                               R"toml(fields = ["q", "p"]
H = "p^2/2 + q^2/2 + q^4/4"
friction = { kind = "cubic", coefficient = 30 }
initial = { q = "0.5", p = "4" })toml",
                                               6,
                                               without_kicks,
                                               {1.0 / 10, 1.0 / 40}},
                                              {"drag",
                                               R"toml(fields = ["q", "p"]
H = "p^2/2 + 1 - cos(q)"
friction = { kind = "quadratic", coefficient = 8 }
initial = { q = "0.5", p = "4" })toml",
                                               6,
                                               without_kicks,
                                               {1.0 / 10, 1.0 / 40}},
                                              {"friction of a place",
                                               R"toml(fields = ["q", "p"]
H = "p^2/2 + q^2/2"
friction = { kind = "position", coefficient = "40*exp(-4*u^2)" }
initial = { q = "2", p = "0" })toml",
                                               6,
                                               without_kicks,
                                               {1.0 / 10, 1.0 / 40}},
                                              {"damping that grows",
                                               R"toml(fields = ["q", "p"]
H = "p^2/2 + q^2/2 + q^4/4"
D = { p = "30*t^2/(1 + t^2)" }
initial = { q = "1", p = "2" })toml",
                                               6,
                                               without_kicks,
                                               {1.0 / 10, 1.0 / 40}}})
    expect_no_worse(of, compared);
  EXPECT_GT(compared, 25);
}

// Where damping is weak and steps are resolved, energies of the default law are what makes it worth having.
TEST(StrongDamping, WrittenIntoSIsTheSame) {
  const auto written = [](const std::string& V, int of_p, double of_r) {
    return fmt::format(R"toml(fields = ["a", "b", "p", "r"]
H = "(p^2 + r^2)/2 + b^2/2 + {}"
S = [[0, 0, 1, 0], [0, 0, 0, 1], [-1, 0, -{}, 0], [0, -1, 0, -{}]]
initial = {{ a = "0.05", b = "1", p = "0", r = "0" }})toml",
                       V, of_p, of_r);
  };
  int compared = 0;
  for (const auto& [name, V, of_p] : std::vector<std::tuple<std::string, std::string, int>>{
           {"cosh", "1e4*(cosh(a) - 1) + a*b^2/2", 20},
           {"exponential spring", "4e3*(exp(a) - 1 - a) + a*b^2/2", 12},
           {"steep pendulum", "900*(1 - cos(3*a)) + 0.3*a^2*b^2", 15}})
    expect_no_worse({name, written(V, of_p, 0.1), 4, without_kicks, {1.0 / 40, 1.0 / 80, 1.0 / 160}}, compared);
  EXPECT_GT(compared, 30);
}

TEST(StrongDamping, OfAGradientFlowInLongStepsIsNoReasonToMoveH) {
  int compared = 0;
  for (const auto& [name, V, start] : std::vector<std::tuple<std::string, std::string, std::string>>{
           {"quartic", "q^4", "3"},
           {"two wells and ripples", "(q^2 - 1)^2/4 + 0.3*sin(6*q)", "1.9"},
           {"steep pendulum", "20*(1 - cos(q)) + q^2/2", "2.8"}})
    expect_no_worse({name,
                     fmt::format(R"toml(fields = ["q"]
H = "{}"
S = [[-1]]
initial = {{ q = "{}" }})toml",
                                 V, start),
                     2,
                     without_kicks,
                     {1.0 / 4, 1.0 / 8, 1.0 / 16, 1.0 / 32}},
                    compared);
  EXPECT_GT(compared, 30);
}

TEST(StrongDamping, IsNotMetInStepsOfWeakDamping) {
  struct Weak {
    std::string D;
    double t_end;
  };
  for (const Weak& weak : {Weak{"0.001", 100}, Weak{"0.05", 40}}) {
    const std::string text = R"toml(fields = ["q", "p"]
H = "p^2/2 + q^2/2 + q^4/4"
D = { p = )toml" + weak.D + R"toml( }
initial = { q = "1", p = "0" })toml";
    const Problem problem = make_problem(read(text));
    const auto end = [&](const char* method, double h, std::optional<EnergyLaw> law) {
      return end_of(solve(problem, {.method = method, .method_options = with_law(law), .h = h, .t_end = weak.t_end}));
    };
    const Vector exact = end("egc8", 1.0 / 64, EnergyLaw::none);
    for (const char* method : {"egc4", "egc6"}) {
      const double guarded = (end(method, 0.25, EnergyLaw::guard) - exact).lpNorm<Eigen::Infinity>();
      EXPECT_LE((end(method, 0.25, {}) - exact).lpNorm<Eigen::Infinity>(), guarded / 2) << weak.D << ", " << method;
    }
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
