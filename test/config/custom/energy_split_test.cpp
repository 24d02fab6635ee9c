// How an energy is taken apart: what goes into M, what into V, and what is kept as it was written.
#include <test/support/written_problem.hpp>

#include <seiche/formula/expansion.hpp>
#include <seiche/formula/formula_parser.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/simulation/solve.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <mutex>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

using ::testing::EndsWith;
using ::testing::HasSubstr;

TEST(EnergySplit, QuadraticTermsBecomeTheMetricAndTheRestThePotential) {
  const Problem p = make_problem(read("H = \"(p + q)^2/2 + q^2 + q^4/4 + 7\"\ninitial = { q = 1, p = 0 }"));
  const Eigen::MatrixXd M = p.M.matrix(p.grid);
  EXPECT_EQ(M, (Eigen::MatrixXd(2, 2) << 3, 1, 1, 1).finished());
  ASSERT_TRUE(p.potential);
  EXPECT_EQ(p.potential->degree(), 4);
  EXPECT_DOUBLE_EQ(p.potential->value(std::vector<double>{2.0}), 11.0);
  ASSERT_FALSE(p.notes.empty());
  EXPECT_THAT(p.notes.front(), AllOf(HasSubstr("½zᵀMz = "), HasSubstr("V = q^4/4 + 7")));
}

TEST(EnergySplit, ANegativeSquareGoesToThePotentialSoThatMStaysSemidefinite) {
  const Problem p = make_problem(read("H = \"p^2/2 - q^2/2 + q^4/4\"\ninitial = { q = 1, p = 0 }"));
  EXPECT_EQ(p.M.matrix(p.grid), (Eigen::MatrixXd(2, 2) << 0, 0, 0, 1).finished());
  EXPECT_DOUBLE_EQ(p.potential->value(std::vector<double>{1.0}), -0.25);
  const Problem coupled =
      make_problem(read("fields = [\"a\", \"b\", \"c\", \"d\"]\nH = \"(c^2 + d^2)/2 + 3*a*b + a^4\"\n"
                        "initial = { a = 1, b = 0, c = 0, d = 0 }"));
  EXPECT_DOUBLE_EQ(coupled.potential->value(std::vector<double>{2.0, 1.0}), 22.0);
  EXPECT_THAT(complaint_of_problem("points = 8\nH = \"v^2/2 - u_x^2/2\"\ninitial = \"zero\""),
              HasSubstr("its quadratic part, "));
}

TEST(EnergySplit, ProductsOfFieldsThatMakeMIndefiniteGoToVAlone) {
  const Problem p = make_problem(
      read("points = 8\nlength = 2.0\nH = \"v^2/2 + u_x^2/2 + 0.1*u*v + 0.05*u_x*v + u^4/4\"\ninitial = \"zero\""));
  EXPECT_EQ(p.M(1, 1).identity_part(), 1) << "v² stays";
  EXPECT_DOUBLE_EQ(p.potential->value(std::vector<double>{1, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0}), 0.45);
}

TEST(EnergySplit, CoefficientsThatAreNoDecimalsAreNumbersAllTheSame) {
  const Problem p =
      make_problem(read("H = \"p^2/2 + sqrt(2)*q^2/2 + sqrt(2*q)*sqrt(q)*q^3\"\ninitial = { q = 1, p = 0 }"));
  EXPECT_DOUBLE_EQ(p.M(0, 0).identity_part(), std::sqrt(2.0));
  EXPECT_NEAR(p.potential->value(std::vector<double>{1.5}), std::sqrt(2.0) * std::pow(1.5, 4), 1e-14);
  EXPECT_THAT(complaint_of_problem("H = \"p^2/2 + (q - q - 1)^0.5*q^2\"\ninitial = { q = 1, p = 0 }"),
              HasSubstr("is not a real function"));
  EXPECT_THAT(complaint_of_problem("H = \"p^2/2\"\nD = { p = \"(t - t - 1)^0.5\" }\ninitial = { q = 1, p = 0 }"),
              HasSubstr("problem.D"));
}

// Where there is no V to count it with.
TEST(EnergySplit, AConstantThatIsLeftOutOfHIsSaid) {
  const Problem p = make_problem(read("H = \"p^2/2 + q^2/2 + 7\"\ninitial = { q = 1, p = 0 }"));
  EXPECT_THAT(p.notes, testing::Contains("7 moves nothing, and H is counted without it"));
  const Problem with_V = make_problem(read("H = \"p^2/2 + q^4 + 7\"\ninitial = { q = 1, p = 0 }"));
  EXPECT_EQ(with_V.potential->value(std::vector<double>{0.0}), 7);
  for (const char* complex : {"sqrt(-1 - q^2 + q^2)", "log(-1 + q - q)"})
    EXPECT_THAT(complaint_of_problem(fmt::format("H = \"p^2/2 + q^2/2 + {}\"\ninitial = {{ q = 1, p = 0 }}", complex)),
                HasSubstr("is not a real function"));
}

// Exact arithmetic would take minutes and gigabytes.
TEST(EnergySplit, PowersWithoutEndAreRefusedAtOnce) {
  for (const char* power : {"(1e300*q)^(-1000000)", "(2.5*q)^-100000", "(sin(q) + 1.000000001)^500000"})
    EXPECT_THAT(complaint_of_problem(fmt::format("H = \"p^2/2 + {}\"\ninitial = {{ q = 1, p = 0 }}", power)),
                HasSubstr("of anything but one name, exponents are at most 1000"))
        << power;
  EXPECT_THAT(complaint_of_problem("H = \"p^2/2 + (1e300*q)^-1000\"\ninitial = { q = 1, p = 0 }"),
              HasSubstr("too many digits"));
  EXPECT_THAT(complaint_of_problem("H = \"p^2/2 + (q - q)^-1\"\ninitial = { q = 1, p = 0 }"),
              HasSubstr("0^(-1) divides by zero"));
  EXPECT_EQ(complaint_of_problem("H = \"p^2/2 + q^4 + (q - q)^0\"\ninitial = { q = 1, p = 0 }"), "");
  EXPECT_EQ(complaint_of_problem("H = \"p^2/2 + q^-12/12 - q^-6/6\"\ninitial = { q = 1, p = 0 }"), "");
}

// A potential is where it is: about q = 10 it acts as about 0, and squares of (q − 10)⁴ are no stiffness.
TEST(EnergySplit, PowersAboutAnotherPointStayAboutIt) {
  const auto end = [](const std::string& H, double q, double p, const char* method) {
    const Problem problem = make_problem(read(fmt::format("H = \"{}\"\ninitial = {{ q = {}, p = {} }}", H, q, p)));
    const Solution s = solve(problem, {.method = method, .h = 1.0 / 64, .t_end = 10});
    EXPECT_EQ(s.report.law, LawVerdict::holds) << H << " " << s.report.law_reason;
    return std::vector<double>(s.z.end() - s.size, s.z.end());
  };
  for (const char* method : {"seisav", "egc4"}) {
    const std::vector<double> here = end("p^2/2 + q^4/4", 1, 0, method);
    const std::vector<double> there = end("p^2/2 + (q - 10)^4/4", 11, 0, method);
    EXPECT_NEAR(there[0] - 10, here[0], 1e-8) << method;
    EXPECT_NEAR(there[1], here[1], 1e-8) << method;
  }
  const Problem high = make_problem(read("H = \"p^2/2 + (q - 3)^20\"\ninitial = { q = 3.5, p = 0.5 }"));
  EXPECT_NEAR(Simulation(high, {.method = "egc4"}).system().energy(high.initial), 0.125 + std::pow(0.5, 20), 1e-12);
  end("p^2/2 + (q - 10)^8", 10.5, 0.5, "egc6");
}

TEST(EnergySplit, SumsThatAreLongMultipliedOutStayAsTheyAreWritten) {
  const AlgebraLock lock;
  const Symbols symbols = make_symbols({"u", "x"});
  const auto is_small = [&](const char* text) {
    const FormulaProgram program = parse_formula(text, {"u", "x"}, {}).program;
    return is_small_polynomial(to_expression(program, symbols), GiNaC::lst{symbols[0]}, symbols);
  };
  for (const char* text : {"(u + 1)^64", "(u + x + 1)^20", "(u - 1/3 + 1/x)^8", "(1e3*u)^8"})
    EXPECT_TRUE(is_small(text)) << text;
  for (const char* text : {"(u + 64/x + x + 5)^64", "(u + 1e300)^60", "(u + x + 1)^64", "abs(u)^3"})
    EXPECT_FALSE(is_small(text)) << text;
}

TEST(EnergySplit, NumbersOfTooManyDigitsEndTheAlgebra) {
  const auto power = [] { return GiNaC::pow(GiNaC::numeric(3), GiNaC::numeric(1'000'000)); };  // of 477 122 digits
  EXPECT_THAT(error_of([&] {
                const AlgebraLock lock;
                power();
              }),
              HasSubstr("exact numbers of more than 78643 digits"));
  EXPECT_EQ(GiNaC::ex_to<GiNaC::numeric>(power()).int_length(), 1'584'963) << "without the lock";
  EXPECT_THAT(error_of([&] {
                const AlgebraLock lock;
                const GiNaC::ex small = GiNaC::pow(GiNaC::numeric(3), GiNaC::numeric(-200));
                GiNaC::pow(GiNaC::symbol("x") + small, 600).expand();
              }),
              HasSubstr("takes too long over its exact numbers"));
}

TEST(EnergySplit, AConstantOfThePlaceAloneStaysWithPoints) {
  const Problem p = make_problem(
      read("points = 17\nboundary = \"dirichlet\"\nH = \"v^2/2 + du^2/2 + du^4/4 + exp(x)\"\ninitial = \"zero\""));
  EXPECT_EQ(p.potential->value(std::vector<double>(16, 0.0)), 0);
}

// Numbers and brackets as the user put them, where every term belongs to one part.
TEST(EnergySplit, PartsAreShownAsTheyWereWritten) {
  const auto note = [](const std::string& H) {
    return make_problem(read("H = \"" + H + "\"\ninitial = { q = 0.5, p = 0.1 }")).notes.front();
  };
  EXPECT_THAT(note("p^2/2 - 0.1/sqrt((q - 0.98)^2 + 1) + (q^2 + p*q)/4 + p^2"),
              EndsWith("with ½zᵀMz = p^2/2 + (q^2 + p*q)/4 + p^2 and V = -0.1/sqrt((q - 0.98)^2 + 1)"));
  EXPECT_THAT(note("p^2/2 + (q^2 + q^4)/4"), EndsWith("and V = 0.25*q^4"))
      << "a term that belongs to both is taken apart";
}

// (du + u)·du − u·du = du²: neither bracket alone may be placed.
TEST(EnergySplit, WhatOneBracketHoldsAnotherMayCancel) {
  const std::string ring = "points = 8\nlength = 8.0\ninitial = { u = \"sin(pi*x/4)\", v = 0 }\n";
  const Problem bracketed = make_problem(read(ring + "H = \"v^2/2 + (du + u)*du/2 - u*du/2\""));
  const Problem plain = make_problem(read(ring + "H = \"v^2/2 + du^2/2\""));
  EXPECT_EQ(bracketed.potential, nullptr);
  EXPECT_DOUBLE_EQ(Simulation(bracketed, {.method = "egc4"}).energy().H,
                   Simulation(plain, {.method = "egc4"}).energy().H);
  EXPECT_EQ(complaint_of_problem("H = \"p^2/2 + (q + 1)^2*q^2 - (q - 1)^2*q^2\"\ninitial = { q = 1, p = 0 }"), "");
}

TEST(EnergySplit, TheForceOfAnOddPowerOfTheModulusIsZeroAtRest) {
  for (const auto& [V, at_two] : std::vector<std::pair<const char*, double>>{
           {"abs(q)^3/3", 4}, {"abs(-q)^3/3", 4}, {"abs(2*q)*q^2/6", 4}, {"abs(q)*q^4/5", 16}, {"abs(q)^5/5", 16}}) {
    const Problem p = make_problem(read(fmt::format("H = \"p^2/2 + {}\"\ninitial = {{ q = 0, p = 1 }}", V)));
    for (const auto& [q, force] : {std::pair(0.0, 0.0), {2.0, at_two}, {-2.0, -at_two}}) {
      Vector gradient(1);
      p.potential->gradient(std::vector{q}, {gradient.data(), 1});
      EXPECT_NEAR(gradient[0], force, 1e-14) << V << " at " << q;
    }
    for (const char* method : {"seisav", "egc4", "avf"})
      EXPECT_EQ(solve(p, {.method = method, .h = 0.1, .t_end = 5}).report.law, LawVerdict::holds) << V << " " << method;
  }
}

// 1/cosh and its derivative are ∞/∞ beyond q = 710.
TEST(EnergySplit, ASechIsZeroFarOut) {
  for (const char* V : {"-sech(q)", "-1/cosh(q)", "q^4/cosh(q)^2", "sech(q)^2"}) {
    const Problem p = make_problem(read(fmt::format("H = \"p^2/2 + {}\"\ninitial = {{ q = 900, p = 1 }}", V)));
    Vector gradient(1);
    p.potential->gradient(std::vector{900.0}, {gradient.data(), 1});
    EXPECT_EQ(gradient[0], 0) << V;
    p.potential->gradient(std::vector{1.25}, {gradient.data(), 1});
    const double d = 1e-5;
    const double difference =
        (p.potential->value(std::vector{1.25 + d}) - p.potential->value(std::vector{1.25 - d})) / (2 * d);
    EXPECT_NEAR(gradient[0], difference, 1e-9) << V;
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
