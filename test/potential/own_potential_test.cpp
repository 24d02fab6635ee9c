// A potential by two functions is one like any other.
#include <seiche/core/base/error.hpp>
#include <seiche/potential/own_potential.hpp>
#include <seiche/potential/polynomials.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/simulation/solve.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace seiche::test {
namespace TEST_FILE {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Values = std::span<const double>;

OwnPotential quartic() {  // Σ u⁴/4, as the polynomial
  return {.value =
              [](Values u) {
                double sum = 0;
                for (const double x : u) sum += x * x * x * x / 4;
                return sum;
              },
          .gradient =
              [](Values u, std::span<double> g) {
                for (std::size_t j = 0; j < u.size(); ++j) g[j] = u[j] * u[j] * u[j];
              },
          .grows_outward = true};
}

OwnPotential sharp() {  // Σ exp(3 cos(2u_j)): no polynomial
  return {.value =
              [](Values u) {
                double sum = 0;
                for (const double x : u) sum += std::exp(3 * std::cos(2 * x));
                return sum;
              },
          .gradient =
              [](Values u, std::span<double> g) {
                for (std::size_t j = 0; j < u.size(); ++j)
                  g[j] = -6 * std::sin(2 * u[j]) * std::exp(3 * std::cos(2 * u[j]));
              }};
}

TEST(OwnPotential, MeanGradientsGiveTheDifferenceOfVAndNoMoreThanItsRoundOff) {
  const auto V = own_potential(sharp());
  const std::vector<double> a = {0.1, -0.7, 2.0};
  for (const double d : {2.0, 1.0, 1e-2, 1e-5, 1e-9, 1e-13, 0.0}) {
    const std::vector<double> b = {0.1 + d, -0.7 - d / 2, 2.0 + d / 3};
    std::vector<double> mean(3), slope(3);
    V->mean_gradient(a, b, mean);
    V->gradient(a, slope);
    double product = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      product += mean[j] * (b[j] - a[j]);
      EXPECT_NEAR(mean[j], slope[j], 500 * d + 1e-12) << d;
    }
    EXPECT_NEAR(product, V->value(b) - V->value(a), 1e-13 * std::abs(V->value(a)) + 1e-14) << d;
  }
}

// The numbers of the polynomial that it is, for every kind of closure and step.
TEST(OwnPotential, RunsAsTheSamePotentialOfTheLibrary) {
  const Problem theirs = klein_gordon({.alpha = 1.0, .gamma = nullptr});
  Problem own = theirs;
  own.potential = own_potential(quartic());
  for (const std::string backend : {"dense", "modal"}) {
    for (const std::string method : {"seavf", "seisav", "seilm", "seidm", "egc4", "crkn4", "etdrk4"}) {
      const SolveOptions o{.method = method, .backend = backend, .h = 1.0 / 32, .t_end = 5};
      const Solution a = solve(theirs, o);
      const Solution b = solve(own, o);
      ASSERT_TRUE(b.success()) << method << ": " << b.report.message;
      double worst = 0;
      for (std::size_t i = 0; i < a.z.size(); ++i) worst = std::max(worst, std::abs(a.z[i] - b.z[i]));
      EXPECT_LE(worst, 1e-11) << method << " on " << backend;
      EXPECT_EQ(b.report.law, LawVerdict::holds) << method << ": " << b.report.message;
    }
  }
}

TEST(OwnPotential, AGradientOfSomethingElseIsSeen) {
  const std::vector<double> u = {0.3, -1.2, 0.7};
  EXPECT_EQ(gradient_complaint(quartic(), u), "");
  EXPECT_EQ(gradient_complaint(sharp(), u), "");
  EXPECT_EQ(gradient_complaint(quartic(), std::vector<double>(3, 0.0)), "");
  OwnPotential wrong = quartic();
  wrong.gradient = [](Values v, std::span<double> g) {
    for (std::size_t j = 0; j < v.size(); ++j) g[j] = 1.01 * v[j] * v[j] * v[j];
  };
  EXPECT_NE(gradient_complaint(wrong, u), "");
  EXPECT_THROW(own_potential({.value = {}, .gradient = {}}), Error);
}

// Wrong where z₀ is not: ∇ of u₀u₁ with one entry missing, at 0 and at states on which it vanishes.
TEST(OwnPotential, AGradientIsComparedComponentByComponentAwayFromTheStartToo) {
  OwnPotential product{.value = [](Values u) { return u[0] * u[1] + u[2] * u[2] / 2; },
                       .gradient =
                           [](Values u, std::span<double> g) {
                             g[0] = u[1];
                             g[1] = u[0];
                             g[2] = u[2];
                           }};
  EXPECT_EQ(gradient_complaint(product, std::vector<double>(3, 0.0)), "");
  product.gradient = [](Values u, std::span<double> g) {
    g[0] = u[1];
    g[1] = 0;
    g[2] = u[2];
  };
  const std::string at_zero = gradient_complaint(product, std::vector<double>(3, 0.0));
  EXPECT_NE(at_zero.find("at a random state of the size 1, its component 1 (from 0) is 0, and"), std::string::npos)
      << at_zero;
  const std::string beside = gradient_complaint(product, std::vector<double>{0.5, 0.0, 0.0});
  EXPECT_NE(beside.find("at the start, its component 1 (from 0) is 0, and differences of V give 0.5"),
            std::string::npos)
      << beside;
}

// A slope that is lost in the sum of all others, and one of a thousand.
TEST(OwnPotential, OneWrongComponentIsSeenBesideLargeOnesAndAmongMany) {
  const auto wrong_at = [](std::size_t wrong) {
    return OwnPotential{.value =
                            [](Values u) {
                              double sum = 1e5 * u[0] * u[0] / 2;
                              for (std::size_t j = 1; j < u.size(); ++j) sum += u[j] * u[j] / 2;
                              return sum;
                            },
                        .gradient =
                            [wrong](Values u, std::span<double> g) {
                              g[0] = 1e5 * u[0];
                              for (std::size_t j = 1; j < u.size(); ++j) g[j] = (j == wrong ? 1.2 : 1.0) * u[j];
                            }};
  };
  const std::string said = gradient_complaint(wrong_at(2), std::vector<double>{1.0, -1.0, 1.0});
  EXPECT_NE(said.find("component 2 (from 0) is 1.2, and differences of V give 1"), std::string::npos) << said;
  EXPECT_EQ(gradient_complaint(wrong_at(9), std::vector<double>{1.0, -1.0, 1.0}), "");

  OwnPotential many = quartic();
  EXPECT_EQ(gradient_complaint(many, std::vector<double>(1000, 0.5)), "");
  many.gradient = [](Values u, std::span<double> g) {
    for (std::size_t j = 0; j < u.size(); ++j) g[j] = (j == 777 ? 3 : 1) * u[j] * u[j] * u[j];
  };
  EXPECT_NE(gradient_complaint(many, std::vector<double>(1000, 0.5)), "");
}

// Of V = Σ cosh 50u, whose fourth differences are large too; and of one that is computed in single precision.
TEST(OwnPotential, SteepPotentialsHideNoWrongGradientAndNoiseIsAccepted) {
  const auto steep = [](double factor) {
    return OwnPotential{.value =
                            [](Values u) {
                              double sum = 0;
                              for (const double x : u) sum += std::cosh(50 * x);
                              return sum;
                            },
                        .gradient =
                            [factor](Values u, std::span<double> g) {
                              for (std::size_t j = 0; j < u.size(); ++j) g[j] = factor * 50 * std::sinh(50 * u[j]);
                            }};
  };
  const auto single = [](double factor) {
    return OwnPotential{.value =
                            [](Values u) {
                              float sum = 0;
                              for (const double x : u) sum += std::cos(static_cast<float>(x));
                              return static_cast<double>(sum);
                            },
                        .gradient =
                            [factor](Values u, std::span<double> g) {
                              for (std::size_t j = 0; j < u.size(); ++j)
                                g[j] = -factor * static_cast<double>(std::sin(static_cast<float>(u[j])));
                            }};
  };
  for (const double start : {0.0, 1e-3, 0.3, 1.0}) {
    const std::vector<double> u = {start, -start / 2, start / 3};
    EXPECT_EQ(gradient_complaint(steep(1), u), "") << start;
    EXPECT_NE(gradient_complaint(steep(1.05), u), "") << start;
    EXPECT_EQ(gradient_complaint(single(1), u), "") << start;
    if (start == 1e-3) continue;  // next to 0 a cosine is 1 to single precision
    EXPECT_NE(gradient_complaint(single(-1), u), "") << start;
  }
}

// Noise of single precision is neither a rise of the energy nor a force along the step, as it would be with h → 0.
TEST(OwnPotential, InSinglePrecisionKeepsTheLawToItsOwnRoundOff) {
  Problem problem = klein_gordon({.alpha = 1.0, .gamma = nullptr});
  const auto cube = [](double x) { return static_cast<float>(x) * static_cast<float>(x) * static_cast<float>(x); };
  problem.potential = own_potential({.value =
                                         [cube](Values u) {
                                           float sum = 0;
                                           for (const double x : u) sum += cube(x) * static_cast<float>(x) / 4;
                                           return static_cast<double>(sum);
                                         },
                                     .gradient =
                                         [cube](Values u, std::span<double> g) {
                                           for (std::size_t j = 0; j < u.size(); ++j) g[j] = cube(u[j]);
                                         }});
  const Problem in_double = klein_gordon({.alpha = 1.0, .gamma = nullptr});
  for (const char* method : {"avf", "seilm", "egc4"}) {
    const SolveOptions options{.method = method, .h = 1.0 / 256, .t_end = 0.5};
    const Solution single = solve(problem, options), exact = solve(in_double, options);
    ASSERT_TRUE(single.success()) << method << ": " << single.report.message;
    EXPECT_NE(single.report.law, LawVerdict::violated) << method << ": " << single.report.law_reason;
    for (std::size_t i = 0; i < exact.z.size(); ++i) ASSERT_NEAR(single.z[i], exact.z[i], 1e-4) << method;
  }
}

TEST(OwnPotential, ARunWithAWrongGradientDoesNotBegin) {
  Problem problem = klein_gordon({.alpha = 1.0, .gamma = nullptr});
  OwnPotential wrong = quartic();
  wrong.gradient = [](Values u, std::span<double> g) {
    for (std::size_t j = 0; j < u.size(); ++j) g[j] = -u[j] * u[j] * u[j];
  };
  problem.potential = own_potential(wrong);
  for (int attempt = 0; attempt < 2; ++attempt)
    EXPECT_THAT([&] { solve(problem, {.h = 0.1, .t_end = 1}); },
                ThrowsMessage<Error>(HasSubstr("the gradient is not that of V: at the start, its component")));
}

// Of V itself, and of a gradient alone, at the one point that comes that far.
TEST(OwnPotential, ARunSaysWhereItIsNotANumber) {
  constexpr double wall = 2;
  Problem problem = klein_gordon({.alpha = 1.0, .gamma = nullptr});
  const Index n = problem.grid.unknowns(), middle = n / 2;
  problem.initial.setZero();
  problem.initial[n + middle] = 400;
  for (const bool of_V : {true, false}) {
    OwnPotential own = quartic();
    const auto beyond = [](double x) { return x > wall ? std::nan("") : 0.0; };
    if (of_V)
      own.value = [V = own.value, beyond](Values u) {
        double sum = V(u);
        for (const double x : u) sum += beyond(x);
        return sum;
      };
    else
      own.gradient = [slope = own.gradient, beyond](Values u, std::span<double> g) {
        slope(u, g);
        for (std::size_t j = 0; j < u.size(); ++j) g[j] += beyond(u[j]);
      };
    problem.potential = own_potential(own);
    for (const char* method : {"seavf", "seilm"}) {
      const Solution failed = solve(problem, {.method = method, .h = 1.0 / 128, .t_end = 1});
      EXPECT_FALSE(failed.success()) << method;
      EXPECT_THAT(failed.report.message,
                  HasSubstr(fmt::format("; {} is not a finite number at u = 2 (x = {:.6g}), straight "
                                        "ahead of t = 0 at t ≈ 0.005",
                                        of_V ? "V" : "∇V", problem.grid.coordinate(middle, 0))))
          << method;
    }
  }
}

// V = −log(1.01 − u) near its wall: it is asked for no farther from the start than differences of it reach.
TEST(OwnPotential, IsNotAskedForBeyondWhereItExists) {
  Problem problem = klein_gordon({.alpha = 1.0, .gamma = nullptr});
  const std::size_t n = static_cast<std::size_t>(problem.grid.unknowns());
  problem.initial.setZero();
  problem.initial.head(static_cast<Index>(n)).setConstant(1);
  problem.potential = own_potential({.value =
                                         [](Values u) {
                                           double sum = 0;
                                           for (const double x : u) {
                                             if (x >= 1.01) throw Error("no V at {}", x);
                                             sum -= std::log(1.01 - x);
                                           }
                                           return sum;
                                         },
                                     .gradient =
                                         [](Values u, std::span<double> g) {
                                           for (std::size_t j = 0; j < u.size(); ++j) g[j] = 1 / (1.01 - u[j]);
                                         }});
  EXPECT_TRUE(solve(problem, {.method = "egc4", .h = 1.0 / 256, .t_end = 1.0 / 64}).success());
}

// A spring that only pushes, and a potential that is nowhere but at u > 0: nothing to complain of.
TEST(OwnPotential, KinksOfTheGradientAndStatesWithoutAPotentialAreNoComplaint) {
  const OwnPotential contact{.value =
                                 [](Values u) {
                                   double sum = 0;
                                   for (const double x : u) sum += x > 0 ? x * x : 0;
                                   return sum;
                                 },
                             .gradient =
                                 [](Values u, std::span<double> g) {
                                   for (std::size_t j = 0; j < u.size(); ++j) g[j] = u[j] > 0 ? 2 * u[j] : 0;
                                 }};
  for (const double start : {0.0, 1e-4, -1e-4, 1.0})
    EXPECT_EQ(gradient_complaint(contact, std::vector<double>(4, start)), "") << start;
  const OwnPotential logarithm{.value =
                                   [](Values u) {
                                     if (u[0] <= 0) throw std::domain_error("log");
                                     return u[0] - std::log(u[0]);
                                   },
                               .gradient =
                                   [](Values u, std::span<double> g) {
                                     if (u[0] <= 0) throw std::domain_error("log");
                                     g[0] = 1 - 1 / u[0];
                                   }};
  EXPECT_EQ(gradient_complaint(logarithm, std::vector<double>{1.0}), "");
  EXPECT_THROW(gradient_complaint(logarithm, std::vector<double>{-1.0}), std::domain_error);
  const OwnPotential cancelling{.value =
                                    [](Values u) {
                                      double sum = 0;
                                      for (const double x : u) sum += std::exp(x) - 1 - x + (1 - std::cos(3 * x));
                                      return sum;
                                    },
                                .gradient =
                                    [](Values u, std::span<double> g) {
                                      for (std::size_t j = 0; j < u.size(); ++j)
                                        g[j] = std::expm1(u[j]) + 3 * std::sin(3 * u[j]);
                                    }};
  for (const double start : {0.0, 1e-12, 1e-8, 1e-5, 1e-3, 0.1, 1.0, 10.0})
    EXPECT_EQ(gradient_complaint(cancelling, std::vector<double>{start, 0, -start, start / 7}), "") << start;
}

}  // namespace TEST_FILE
}  // namespace seiche::test
