// What round-off explains of a rise of the energy, and what it does not.
#include <seiche/config/custom/custom_problem.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/law/law.hpp>
#include <seiche/problem/chain.hpp>
#include <seiche/simulation/solve.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace seiche {
namespace TEST_FILE {

using testing::HasSubstr;

Problem oscillator_of(const std::string& H, double q, double p) {
  return custom_problem({.H = H, .initial = {{"q", fmt::format("{}", q)}, {"p", fmt::format("{}", p)}}});
}

// All terms of H are 1e-16 there, and of order one once the solution has left.
TEST(RoundOff, OfASolutionThatLeavesAnUnstableRestIsNoViolation) {
  const Problem p = oscillator_of("p^2/2 - q^2/2 + q^4/4", 1e-8, 0);
  for (const char* method : {"seilm", "savf", "egc6", "crkn4"}) {
    const Solution s = solve(p, {.method = method, .h = 1.0 / 16, .t_end = 50});
    ASSERT_TRUE(s.success()) << method << ": " << s.report.message;
    EXPECT_EQ(s.report.law, LawVerdict::not_promised) << method << ": " << s.report.law_reason;
    EXPECT_THAT(s.report.law_reason, HasSubstr("can no longer be told from round-off: at t = ")) << method;
    EXPECT_NEAR(s.H.back(), s.H.front(), 1e-12) << method;
  }
}

// H is 1e-29 there, left over of 1/4 − u²/2 + u⁴/4; what transforms round moves the state by 1e-16.
TEST(RoundOff, OfAFieldThatRestsInAWellIsNoDriftOfItsEnergy) {
  const Problem at_rest = custom_problem({.grid = GridOptions{.points = {32, 32}, .length = {10, 10}},
                                          .H = "v^2/2 + u_x^2/2 + u_y^2/2 + (u^2 - 1)^2/4",
                                          .initial = {{"u", "1"}, {"v", "0"}}});
  for (const char* method : {"seisav", "sav", "seilm", "avf", "egc4", "crkn6"}) {
    const Solution s = solve(at_rest, {.method = method, .h = 1.0 / 16, .t_end = 2});
    EXPECT_FALSE(s.report.drift) << method << ": " << s.report.message;
    EXPECT_EQ(s.report.law, LawVerdict::holds) << method << ": " << s.report.message;
    EXPECT_GT(s.H.back(), 1.2 * s.H.front()) << method << " has nothing to be told from round-off";
  }
}

TEST(RoundOff, BehindAnEventIsThatOfTheStateItLeft) {
  const Problem p = oscillator_of("p^2/2 - cos(q)", 0, 0);
  SolveOptions o{.method = "egc4", .h = 1.0 / 64, .t_end = 20};
  o.events = {{.g = [](double t, const Vector&) { return t - 5; }, .action = [](double, Vector& z) { z[1] = 1; }}};
  const Solution s = solve(p, o);
  EXPECT_EQ(s.report.law, LawVerdict::holds) << s.report.law_reason;
}

// Round-off in q makes an error of |q sin q|ε in cos q, which is far more than |cos q|ε; a projection that knew nothing
// of that would miss its energies and let H sink.
TEST(RoundOff, OfAnglesThatGoRoundAndRoundKeepsTheEnergyWhereItIs) {
  for (const double q : {0.0, 1000.0}) {
    const Problem p = oscillator_of("p^2/2 - cos(q)", q, 3);
    for (const char* method : {"seilm", "savf", "seidm", "egc2", "egc4", "egc6"}) {
      const Solution s = solve(p, {.method = method, .h = 1.0 / 16, .t_end = 200, .record_every = 10});
      EXPECT_EQ(s.report.law, LawVerdict::holds) << method << " " << q << ": " << s.report.law_reason;
      EXPECT_NEAR(s.H.back(), s.H.front(), 3e-11) << method << " " << q;
    }
  }
}

// In full matrices ½zᵀMz is a small sum of large terms: of (Δx)⁻⁴ in a beam.
TEST(RoundOff, OfDifferencesOfHighOrderIsThatOfTheirTerms) {
  const Problem beam = custom_problem({.grid = GridOptions{.points = {12}, .boundary = {Boundary::dirichlet}},
                                       .H = "v^2/2 + u_xx^2/2 + u^4/4",
                                       .initial = {{"u", "5*sin(pi*x)"}, {"v", "0"}}});
  for (const char* backend : {"dense", "sparse", "modal"}) {
    for (const char* method : {"seisav", "eisav", "ssav", "seilm", "egc4", "egc6"}) {
      const Solution s = solve(beam, {.method = method, .backend = backend, .h = 1.0 / 64, .t_end = 2});
      EXPECT_EQ(s.report.law, LawVerdict::holds) << backend << " " << method << ": " << s.report.law_reason;
    }
  }
  const Problem wave = custom_problem({.grid = GridOptions{.points = {12}, .boundary = {Boundary::neumann}},
                                       .H = "v^2/2 + u_x^2/2 + 1 - cos(u)",
                                       .initial = {{"u", "5 + 0.1*cos(pi*x)"}, {"v", "0"}}});
  const Solution s = solve(wave, {.method = "seisav", .h = 1.0 / 64, .t_end = 2});
  EXPECT_EQ(s.report.law, LawVerdict::holds) << s.report.law_reason;
}

// Steps that shrink do not make round-off smaller.
TEST(RoundOff, OfAStiffBeamDoesNotStopATolerance) {
  const Problem beam = custom_problem({.grid = GridOptions{.points = {11}, .discretisation = Discretisation::spectral},
                                       .H = "v^2/2 + u_xx^2/2 + u^4/4",
                                       .D = {{"0", "0"}, {"0", "0.1"}},
                                       .initial = {{"u", "sin(2*pi*x)"}, {"v", "0"}}});
  for (const char* method : {"egc4", "egc6", "egc8"}) {
    const Solution s = solve(beam, {.method = method, .tolerance = 1e-10, .t_end = 0.25});
    EXPECT_TRUE(s.success()) << method << ": " << s.report.message;
    EXPECT_LT(s.report.steps, 3000) << method;
  }
}

// ρ³ − ρ² is 0 at ρ = 1, and its terms are not.
TEST(RoundOff, OfTermsThatCancelAtEveryPointIsThatOfTheTerms) {
  const Problem p = custom_problem({.fields = {"p", "q"},
                                    .grid = GridOptions{.points = {32}},
                                    .H = "(p_x^2 + q_x^2)/2 + (p^2 + q^2)^3 - (p^2 + q^2)^2",
                                    .S = {{"0", "1"}, {"-1", "0"}},
                                    .initial = {{"p", "1"}, {"q", "0"}}});
  for (const char* method : {"savf", "seilm", "egc4"}) {
    const Solution s = solve(p, {.method = method, .h = 1.0 / 64, .t_end = 2});
    EXPECT_EQ(s.report.law, LawVerdict::holds) << method << ": " << s.report.law_reason;
  }
}

TEST(RoundOff, OfALongUniformChainDoesNotAddUp) {
  Problem p = chain({.points = 65536, .boundary = Boundary::periodic, .ground_cubic = 1});
  p.initial.setZero();
  p.initial.head(65536).setConstant(0.7);
  for (const char* method : {"savf", "egc4"}) {
    const Solution s = solve(p, {.method = method, .h = 1.0 / 64, .t_end = 0.5, .record_every = 8});
    EXPECT_EQ(s.report.law, LawVerdict::holds) << method << ": " << s.report.law_reason;
  }
}

}  // namespace TEST_FILE
}  // namespace seiche
