// What is said of names in formulas: where they stand, what stands for them, and nothing that only looks alike.
#include <test/support/error_of.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/core/momenta.hpp>
#include <seiche/simulation/certificate.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string oscillator = "H = \"p^2/2 + q^4/4\"\ninitial = { q = 1, p = 0 }\n";
const std::string ring = "length = 1.0\npoints = 8\nH = \"v^2/2 + u^4/4\"\ninitial = \"zero\"\n";

Problem made(const std::string& problem, const std::vector<std::string>& overrides = {}) {
  return make_problem(
      parse_case("[problem]\nname = \"custom\"\n" + problem + "\n[time]\nend = 10\n", "x.toml", overrides));
}

std::string said(const std::string& problem, const std::vector<std::string>& overrides = {}) {
  return error_of([&] { made(problem, overrides); });
}

double friction_at(const Problem& problem, double u, double v) {
  double r = NAN;
  problem.friction->force(0, {&u, 1}, {&v, 1}, {&r, 1});
  return r;
}

TEST(FrictionNames, FieldsMayBeNamedAsTheyAreWhereThereIsOnePair) {
  const auto with = [](const std::string& friction) { return made(oscillator + "friction = " + friction); };
  const Problem by_fields = with("{ kind = \"formula\", r = \"0.1*p^3*(1 + q^2)\" }");
  const Problem by_letters = with("{ kind = \"formula\", r = \"0.1*v^3*(1 + u^2)\" }");
  EXPECT_DOUBLE_EQ(friction_at(by_fields, 2.0, 3.0), 0.1 * 27 * 5);
  EXPECT_DOUBLE_EQ(friction_at(by_letters, 2.0, 3.0), 0.1 * 27 * 5);
  EXPECT_DOUBLE_EQ(friction_at(with("{ kind = \"position\", coefficient = \"q^2 + 1\" }"), 2.0, 3.0), 15);
}

TEST(FrictionNames, AMomentumIsItsVelocityDividedByTheInverseMass) {
  const Problem heavy =
      made("H = \"p^2/8 + q^4/4\"\ninitial = { q = 1, p = 0 }\nfriction = { kind = \"formula\", r = \"p + 10*v\" }");
  ASSERT_TRUE(momenta(heavy));
  EXPECT_DOUBLE_EQ(momenta(heavy)->inverse_mass, 0.25);
  EXPECT_DOUBLE_EQ(friction_at(heavy, 0.0, 1.0), 4 + 10) << "p = v/w";
}

TEST(FrictionNames, WhatTheUserWroteIsWhatTheCaseFileKeeps) {
  const std::string text =
      "[problem]\nname = \"custom\"\n" + oscillator + "friction = { kind = \"formula\", r = \"0.1*p^3\" }\n";
  EXPECT_THAT(write_case(parse_case(text, "x.toml")), HasSubstr("r = \"0.1*p^3\""));
}

TEST(FrictionNames, NamesWithTwoMeaningsAreRefused) {
  EXPECT_THAT(said("fields = [\"v\", \"p\"]\nH = \"p^2/2 + v^4/4\"\ninitial = \"zero\"\n"
                   "friction = { kind = \"formula\", r = \"0.1*v\" }"),
              HasSubstr("v is the velocity here, and a field of that name is not"));
  EXPECT_THAT(said("fields = [\"a\", \"b\", \"p\", \"r\"]\nH = \"p^2/2 + r^2/2 + a^2*b^2\"\ninitial = \"zero\"\n"
                   "friction = { kind = \"formula\", r = \"0.1*p\" }"),
              HasSubstr("p is a field, and the formula serves every coordinate with its velocity: write u and v"));
}

TEST(NameAdvice, NoLetterIsTakenForAnother) {
  const std::string unknown = said(oscillator, {"problem.H=p^2/2 + c*q^4"});
  EXPECT_THAT(unknown, AllOf(HasSubstr("unknown name 'c': it is neither a field (q, p) nor a parameter; for a number "
                                       "of your own write problem.parameters = { c = … }"),
                             HasSubstr("Allowed: q, p, pi"), Not(HasSubstr("did you mean"))));
  EXPECT_THAT(said(oscillator, {"problem.H=p^2/2 + Q^4"}), HasSubstr("did you mean 'q'?"));
  EXPECT_THAT(said(oscillator + "parameters = { kappa = 1 }", {"problem.H=p^2/2 + kapa*q^4"}),
              HasSubstr("did you mean 'kappa'?"));
}

TEST(NameAdvice, WordsOfTheLanguageSayWhereTheyStand) {
  EXPECT_THAT(said(oscillator, {"problem.H=p^2/2 + k*q^4"}),
              AllOf(HasSubstr("k, the wave number, stands in S, M and D only, on a grid with Fourier modes"),
                    HasSubstr("problem.parameters = { k = … }")));
  EXPECT_THAT(said(oscillator, {"problem.H=p^2/2 + x*q^4"}), HasSubstr("x needs a grid"));
  EXPECT_THAT(said(oscillator, {"problem.H=p^2/2 + t*q^4"}), HasSubstr("the energy has no t"));
  EXPECT_THAT(said(oscillator, {"problem.H=p^2/2 + q_x^2"}), HasSubstr("q_x needs a grid"));
  EXPECT_THAT(said(oscillator, {"problem.H=p^2/2 + dq^4"}), HasSubstr("dq needs a grid"));
  EXPECT_THAT(said(oscillator, {"problem.D={ p = \"0.1*q\" }"}),
              AllOf(HasSubstr("D is linear"), HasSubstr("problem.friction")));
  EXPECT_THAT(said(oscillator, {"problem.D={ p = \"laplacian\" }"}), HasSubstr("laplacian needs a grid"));
  EXPECT_THAT(said(oscillator, {"problem.S=[[0, \"t\"], [-1, 0]]"}), HasSubstr("entries of S and M have no t"));
  EXPECT_THAT(said(oscillator, {"problem.S=[[0, \"q\"], [-1, 0]]"}),
              AllOf(HasSubstr("entries of S and M are constant"), HasSubstr("egc2 … egc8")));
  EXPECT_THAT(said(oscillator, {"problem.force=0.1*q"}),
              HasSubstr("q is a field, and an external force is a formula in t"));
  EXPECT_THAT(said(oscillator, {"problem.force=0.1*x"}), HasSubstr("x needs a grid"));
  EXPECT_THAT(said(oscillator, {"problem.friction={ kind = \"formula\", r = \"x*v\" }"}), HasSubstr("x needs a grid"));
  EXPECT_THAT(said(oscillator, {"problem.initial={ q = \"x\", p = 0 }"}), HasSubstr("x needs a grid"));
  EXPECT_THAT(said(oscillator, {"problem.initial={ q = \"t\", p = 0 }"}), HasSubstr("initial values have no t"));
  EXPECT_THAT(said(ring, {"problem.H=v^2/2 + y*u^4"}), HasSubstr("the grid has 1 axis"));
  EXPECT_THAT(said(ring, {"problem.H=v^2/2 + u*laplacian"}), HasSubstr("in an energy write u_x or u_xx"));
  EXPECT_THAT(said(ring, {"problem.D={ v = \"0.1*u_x\" }"}), HasSubstr("d_x, d_x^2, laplacian"));
}

TEST(NameAdvice, DerivativesAreSpelledOut) {
  for (const char* other : {"ux", "uxx", "diff(u,x)", "grad(u)", "laplace(u)"})
    EXPECT_THAT(said(ring, {"problem.H=v^2/2 + " + std::string(other)}),
                HasSubstr("derivatives of a field u are written u_x and u_xx"))
        << other;
  for (const std::string velocity : {"ut", "u_t", "u_tt"})
    EXPECT_THAT(said(ring, {"problem.H=" + velocity + "^2/2 + u^4/4"}),
                HasSubstr(velocity + " is a velocity, which is a field of its own, and the fields are u, v"));
  EXPECT_THAT(said(ring, {"problem.H=v^2/2 + u'^2"}), HasSubstr("the derivative of u along x is u_x"));
  EXPECT_THAT(said(ring, {"problem.D={ v = \"grad(u)\" }"}), HasSubstr("d_x, d_x^2, laplacian"));
}

TEST(NameAdvice, LengthPointsAndSpacingAreKnownInEveryFormula) {
  const std::string all = "x/length + dx/length + 1/points";
  EXPECT_EQ(said("length = 2.0\npoints = 8\nH = \"v^2/2 + u^4/4*(" + all + ")\"\n" + "D = { v = \"" + all +
                 "\" }\nforce = { v = \"" + all + "\" }\n" + "friction = { kind = \"formula\", r = \"v*(" + all +
                 ")\" }\n" + "initial = { u = \"" + all + "\", v = 0 }\n"),
            "");
  EXPECT_EQ(error_of([&] {
              make_problem(parse_case("[problem]\nname = \"klein_gordon\"\ngamma = \"kappa*(" + all + ")\"", "x.toml"));
            }),
            "");
}

TEST(NameAdvice, NeighboursAreReachedByTheDifference) {
  for (const char* neighbour : {"u[j+1]", "u[i]", "u(j+1)", "u(n-1)"}) {
    const std::string hint = said(ring, {"problem.H=v^2/2 + (" + std::string(neighbour) + " - u)^4"});
    EXPECT_THAT(hint, HasSubstr("column 11: u has no index: du is the difference to the next point, u_{j+1} − u_j"))
        << neighbour;
  }
  const std::string plane = "length = [1.0, 1.0]\npoints = [8, 8]\nH = \"v^2/2 + u^4/4\"\ninitial = \"zero\"\n";
  EXPECT_THAT(said(plane, {"problem.H=v^2/2 + u[i][j]^4"}), HasSubstr("u has no index: u_x is its derivative along x"));
  EXPECT_THAT(said(ring + "parameters = { k = 2 }", {"problem.H=v^2/2 + u(k+1)"}),
              HasSubstr("for a product write u*(…)"));
  EXPECT_THAT(said(oscillator, {"problem.H=p^2/2 + q[1]^4"}), AllOf(HasSubstr("'['"), Not(HasSubstr("next point"))));
}

TEST(NameAdvice, UnitsAreNotPartOfTheLanguage) {
  EXPECT_THAT(said(oscillator, {"time.end=1 s"}), HasSubstr("units such as s are not part of the language"));
  EXPECT_THAT(said(oscillator, {"problem.force=cos(5 Hz*t)"}),
              HasSubstr("units such as Hz are not part of the language"));
  EXPECT_THAT(said(oscillator + "parameters = { s = 2 }", {"problem.H=p^2/2 + 2 s*q^4"}), HasSubstr("write 2*s"))
      << "a name of the user's own";
}

TEST(NameAdvice, MinAndMaxBesideDerivativesSayWhatDTakes) {
  EXPECT_THAT(said(ring, {"problem.D={ v = \"max(0.1, laplacian)\" }"}),
              AllOf(HasSubstr("max does not stand beside derivatives or wave numbers"),
                    HasSubstr("D takes coefficients of derivatives, or a rate"), Not(HasSubstr("no derivative here"))));
  EXPECT_EQ(said(ring, {"problem.D={ v = \"max(0.1, sin(t))\" }"}), "");
  EXPECT_THAT(said(oscillator, {"problem.H=p^2/2 + max(q, 1)"}),
              HasSubstr(
                  "problem.H: formula, column 9: max has no derivative, and forces are derivatives of the energy"));
}

TEST(DottedKeys, ReachIntoTablesAndLeaveTheOtherEntriesAsTheyAre) {
  const std::string damped = oscillator + "D = { q = 0.3, p = 0.1 }\nparameters = { a = 1 }\nforce = \"a*t\"";
  const Problem p = made(damped, {"problem.D.p=0.2", "problem.initial.q=2", "problem.parameters.a=5"});
  EXPECT_EQ(p.initial[0], 2);
  EXPECT_EQ(p.initial[1], 0);
  EXPECT_EQ(p.damping.constant(0, 0).identity_part(), 0.3);
  EXPECT_EQ(p.damping.constant(1, 1).identity_part(), 0.2);
  std::vector<double> f(1);
  p.forces[1]->values(1, f);
  EXPECT_EQ(f[0], 5);
  const Problem alone = made(oscillator, {"problem.D.p=0.2"});
  EXPECT_EQ(alone.damping.rate->value(0), 0.2) << "a table that was not there is made";
  EXPECT_EQ(alone.initial[0], 1);
}

TEST(DottedKeys, WrongOnesAreRefusedWithTheUsualSentence) {
  EXPECT_THAT(said(oscillator, {"problem.D.w=0.2"}),
              AllOf(HasSubstr("--set problem.D.w=0.2: unknown field in problem.D 'w'"), HasSubstr("Allowed: q, p")));
  EXPECT_THAT(said(oscillator, {"problem.initial.w=0.2"}), HasSubstr("unknown key in problem.initial 'w'"));
  EXPECT_THAT(said(oscillator, {"problem.initial.q=r"}),
              HasSubstr("--set problem.initial.q=r: problem.initial.q: formula, column 1: unknown name 'r'"));
  EXPECT_THAT(said(oscillator, {"problem.H.q=1"}), HasSubstr("problem.H = \"p^2/2 + q^4/4\" is no table"));
  EXPECT_THAT(said(ring, {"problem.initial.u=1"}),
              AllOf(HasSubstr("problem.initial = \"zero\" is no table"), HasSubstr("problem.initial={ u = 1 }")));
  EXPECT_THAT(said(oscillator + "D = { p = 0.1 }", {"problem.D.p.w=1"}),
              AllOf(HasSubstr("problem.D.p = 0.1 is no table"), Not(HasSubstr("={"))));
  EXPECT_THAT(said(oscillator, {"problem.D..p=1"}), HasSubstr("a key is missing between two dots"));
  EXPECT_THAT(said(oscillator, {"method.h.p=1"}), HasSubstr("method.h"));
}

TEST(InitialState, EveryFieldThatIsMissingIsNamedWithWhatToWrite) {
  EXPECT_THAT(
      said("H = \"p^2/2\"\ninitial = { q = 1 }"),
      HasSubstr(
          "problem.initial has no formula for the field p; write p = 0 beside the others, or initial = \"zero\""));
  EXPECT_THAT(said("fields = [\"a\", \"b\", \"p\", \"r\"]\nH = \"p^2/2\"\ninitial = { a = 1 }"),
              HasSubstr("no formula for the fields b, p, r; write b = 0, p = 0, r = 0"));
  EXPECT_THAT(said("H = \"p^2/2\"", {"problem.initial.q=1"}), HasSubstr("no formula for the field p"));
}

TEST(FewDegreesOfFreedom, HaveNoModesInTheirCertificate) {
  const std::string damped = oscillator + "D = { p = 0.1 }\n";
  const auto text_of = [](const Problem& problem) {
    std::string text;
    for (const Hypothesis& h : certify(problem, {.t_end = 1}).hypotheses) text += h.statement + "\n" + h.witness + "\n";
    return text;
  };
  EXPECT_THAT(text_of(made(damped)),
              AllOf(HasSubstr("S + Sᵀ = 0"), HasSubstr("the smallest eigenvalue is"), Not(HasSubstr("mode"))));
  EXPECT_THAT(text_of(made("S = [[0.1, 1], [-1, 0]]\n" + damped)),
              AllOf(HasSubstr("z = (q: "), Not(HasSubstr("mode"))));
  EXPECT_THAT(text_of(made(ring + "D = { v = 0.1 }")), HasSubstr("over all modes"));
}

TEST(OrderOfComplaints, WhatTheProblemLacksComesBeforeHowItStarts) {
  EXPECT_THAT(said("fields = [\"a\", \"b\", \"c\"]\nH = \"a^2\""), HasSubstr("S is not given"));
  EXPECT_THAT(said(""), HasSubstr("[problem] has no energy"));
  EXPECT_THAT(said("H = \"p^2/2\""), HasSubstr("no initial state"));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
