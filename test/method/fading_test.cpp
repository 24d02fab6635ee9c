// Solutions that fade to 1e-20 of their energy in potentials whose terms cancel there: the law holds, steps are solved,
// and their number stays what it is elsewhere.
#include <test/support/written_problem.hpp>

#include <seiche/method/methods.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/simulation/solve.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>

namespace seiche::test {
namespace TEST_FILE {

// With a minimum of 0 at x = 0, and a curvature there between about 1 and 10.
std::string random_well(const std::string& x, std::mt19937_64& random) {
  static const std::array shapes = {"{c}*log(1 + {x}^2)",
                                    "{c}*(1 - exp(-{x}))^2",
                                    "{c}*(exp(0.8*{x}) - 0.8*{x} - 1)",
                                    "{c}*(cosh({x}) - 1)",
                                    "{c}*(1 - cos({x}))",
                                    "{c}*(sqrt(1 + {x}^2) - 1)",
                                    "{c}*tanh({x})^2",
                                    "{c}*((1 + 0.2*{x})^(-12) - 2*(1 + 0.2*{x})^(-6) + 1)",
                                    "{c}*{x}^2/(1 + {x}^2)",
                                    "{c}*log(cosh({x}))",
                                    "{c}*(exp({x}^2) - 1)",
                                    "{c}*{x}*atan({x})",
                                    "{c}*((1 + {x}^2)^1.5 - 1)",
                                    "{c}*(2 - cos({x}) - exp(-{x}^2))"};
  std::uniform_real_distribution<double> factor(1, 3);
  std::string well;
  for (int terms = 1 + static_cast<int>(random() % 3); terms > 0; --terms) {
    const std::string shape = shapes[random() % shapes.size()];
    well += (well.empty() ? "" : " + ") +
            fmt::format(fmt::runtime(shape), fmt::arg("c", fmt::format("{:.3f}", factor(random))), fmt::arg("x", x));
  }
  return well;
}

struct Fading {
  std::string text;
  double t_end;
};

Fading random_fading(std::mt19937_64& random) {
  std::uniform_real_distribution<double> rate(0.5, 1), start(-0.5, 0.5);
  const double gamma = rate(random);
  const double t_end = 50 / gamma;  // e⁻⁵⁰ = 2e-22
  if (random() % 2 == 0)
    return {fmt::format("H = \"p^2/2 + {}\"\nD = {{ p = {} }}\ninitial = {{ q = \"{}\", p = \"0\" }}",
                        random_well("q", random), gamma, start(random)),
            t_end};
  return {
      fmt::format("fields = [\"a\", \"b\", \"p\", \"r\"]\nH = \"(p^2 + r^2)/2 + {} + {}\"\nD = {{ p = {}, r = {} }}\n"
                  "initial = {{ a = \"{}\", b = \"{}\", p = \"0\", r = \"0.1\" }}",
                  random_well("a", random), random_well("(b - a)", random), gamma, gamma, start(random), start(random)),
      t_end};
}

TEST(Fading, OfAHundredRandomPotentialsIsNoViolationAndNoFailure) {
  constexpr unsigned seed = 33;
  std::mt19937_64 random(seed);
  int runs = 0;
#if defined(SEICHE_SANITIZED)
  constexpr int potentials = 10;
#else
  constexpr int potentials = 100;
#endif
  for (int i = 0; i < potentials; ++i) {
    const Fading of = random_fading(random);
    const Problem problem = make_problem(read(of.text));
    for (const MethodEntry& method : methods()) {
      const SolveOptions options{.method = std::string(method.name), .h = 1.0 / 8, .t_end = of.t_end};
      const Solution s = solve(problem, options);
      ++runs;
      EXPECT_TRUE(s.success()) << of.text << "\n" << method.name << ": " << s.report.message;
      EXPECT_NE(s.report.law, LawVerdict::violated) << of.text << "\n" << method.name << ": " << s.report.law_reason;
      double largest = 0;
      for (std::size_t k = s.z.size() - static_cast<std::size_t>(s.size); k < s.z.size(); ++k)
        largest = std::max(largest, std::abs(s.z[k]));
      EXPECT_LE(largest, 1e-8) << of.text << "\n" << method.name;
    }
    for (const char* method : {"egc4", "egc8"}) {
      const Solution s = solve(problem, {.method = method, .tolerance = 1e-8, .t_end = of.t_end});
      EXPECT_TRUE(s.success()) << of.text << "\n" << method << " by tolerance: " << s.report.message;
      EXPECT_NE(s.report.law, LawVerdict::violated) << of.text << "\n" << method << ": " << s.report.law_reason;
      EXPECT_LT(s.report.steps, 20000) << of.text << "\n" << method;
    }
  }
  EXPECT_GE(runs, 10 * potentials);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
