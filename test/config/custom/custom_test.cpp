// Problems written down: what comes of their formulas, and what is said where nothing can.
#include <test/support/cases.hpp>
#include <test/support/error_of.hpp>
#include <test/support/written_problem.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/law/law.hpp>
#include <seiche/problem/nls.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/simulation/solve.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

Vector final_state(const Problem& problem, const std::string& method, double h, int steps) {
  Simulation simulation(problem, {.method = method});
  for (int n = 0; n < steps; ++n) EXPECT_TRUE(simulation.step(h).solved());
  return simulation.physical();
}

struct WrittenCase {
  std::string name;
  std::string problem;
};

// The paper's examples (section 4) as a user would write them.
const std::vector<WrittenCase>& written_paper_cases() {
  static const std::string fpu = R"toml(
length = 2.0
points = 20
boundary = "dirichlet"
parameters = { epsilon = 0.005, beta = 0.01, gamma = 0.5 }
H = "v^2/2 + u_x^2/2 + u^2/2 + epsilon/6*(du/dx)^3"
initial = { u = "5*(log(1 + exp(0.2*(j - 97))) + log(1 + exp(0.2*(j - 32))) - log(1 + exp(0.2*(j - 96))) - log(1 + exp(0.2*(j - 33))))", v = 0 }
)toml";
  static const std::vector<WrittenCase> cases = {
      {"paper_KG", R"toml(
length = 2.0
points = 20
parameters = { kappa = 0.04, omega2 = 0.2, alpha = -1.0, gamma = 0.1 }
H = "v^2/2 + kappa/2*u_x^2 + omega2/2*u^2 + alpha/4*u^4"
D = { v = "gamma" }
initial = { u = "tanh(sqrt(2)*x)/sqrt(5)", v = "-3*sqrt(2)/(10*sqrt(5))*sech(sqrt(2)*x)^2" }
)toml"},
      {"paper_FPU_2.1", fpu + "D = { v = \"gamma - beta*laplacian\" }"},
      {"paper_FPU_2.2", fpu + "S = [[0, 1], [-1, \"-gamma\"]]\nD = { v = \"-beta*laplacian\" }"},
      {"paper_gKdV", R"toml(
fields = ["u"]
length = 10.0
points = 20
parameters = { epsilon = 1.0, sigma = 0.001, mu = 0.5 }
H = "epsilon/2*u_x^2 - sigma/4*u^4"
S = "d_x"
D = "mu"
initial = { u = "0.4*exp(-(x - 5)^2/2)" }
)toml"},
  };
  return cases;
}

TEST(Custom, AnMThatIsNotSymmetricIsRefused) {
  EXPECT_THAT(complaint_of_problem("M = [[2, 1], [0, 1]]\ninitial = \"zero\"\n"),
              HasSubstr("problem.M must be symmetric, but row 2, column 1 is \"0\" and row 1, column 2 is \"1\""));
  const std::string ring = "length = 1.0\npoints = 8\ninitial = \"zero\"\n";
  EXPECT_THAT(complaint_of_problem(ring + "M = [[2, \"d_x\"], [\"d_x\", \"300 - laplacian\"]]\n"),
              HasSubstr("changes its sign there"));
  EXPECT_EQ(complaint_of_problem(ring + "M = [[2, \"d_x\"], [\"-d_x\", \"300 - laplacian\"]]\n"), "");
  EXPECT_THAT(complaint_of_problem(ring + "fields = [\"u\"]\nS = \"d_x\"\nM = \"1 + d_x\"\n"),
              HasSubstr("is not symmetric"));
}

TEST(Custom, AFieldThatTheEnergyForgetsIsSaid) {
  const auto notes = [](const std::string& problem) {
    std::string all;
    for (const std::string& note : make_problem(read("initial = \"zero\"\n" + problem)).notes) all += note + "\n";
    return all;
  };
  EXPECT_THAT(notes("H = \"q^4/4\"\n"),
              HasSubstr("the energy does not name p: S gives q no velocity, and H does not move q"));
  EXPECT_THAT(notes("H = \"p^2/2\"\n"), HasSubstr("the energy does not name q: S gives p no force"));
  EXPECT_THAT(notes("fields = [\"a\", \"b\", \"c\"]\nS = [[0, 1, 0], [-1, 0, 0], [0, 0, 0]]\nH = \"a^4*c^2 + a^2\"\n"),
              AllOf(HasSubstr("∂H/∂b = 0"), Not(HasSubstr("∂H/∂c"))))
      << "between two that V names";
  EXPECT_THAT(notes("H = \"p^2/2 + cos(q)\"\n"), Not(HasSubstr("does not name")));
  EXPECT_THAT(notes("length = 1.0\npoints = 8\nH = \"v^2/2 + du^2/2 + du^3/6\"\n"), Not(HasSubstr("does not name")));
}

TEST(Custom, ThePapersCasesWrittenDownEndWhereTheBuiltInOnesDo) {
  for (const WrittenCase& written : written_paper_cases()) {
    const Problem mine = make_problem(read(written.problem));
    const std::vector<NamedProblem> cases = golden_cases();
    const auto& given = std::find_if(cases.begin(), cases.end(), [&](const auto& c) { return c.name == written.name; });
    ASSERT_NE(given, cases.end());
    EXPECT_LE((mine.initial - given->problem.initial).lpNorm<Eigen::Infinity>(), 4e-15) << written.name;
    for (const char* method : {"seisav", "seilm", "savf", "egc6"}) {
      const Vector a = final_state(mine, method, 1.0 / 32, 320);
      const Vector b = final_state(given->problem, method, 1.0 / 32, 320);
      EXPECT_LE((a - b).lpNorm<Eigen::Infinity>(), 1e-12 * (1 + b.lpNorm<Eigen::Infinity>()))
          << written.name << " " << method;
    }
  }
}

TEST(Custom, ThePotentialOfOneFieldIsAsFastAsABuiltInOne) {
  const Problem p = make_problem(read("points = 8\nH = \"v^2/2 + u_x^2/2 + 0.3*u^4*u^2 - u^3\"\ninitial = \"zero\""));
  EXPECT_TRUE(p.potential->is_local());
  EXPECT_EQ(p.potential->degree(), 6);
  std::vector<double> c(7);
  p.potential->along(std::vector<double>{0.0}, std::vector<double>{1.0}, c);
  EXPECT_EQ(c, (std::vector<double>{0, 0, 0, -1, 0, 0, 0.3}));
}

// Σ|ψ|² = e^{−2γt}, as for the built-in equation, whose mean gradient is a multiple of the mean of ψ.
TEST(Custom, APowerOfTheModulusIsFoundAndKeepsTheLawOfMass) {
  const Problem p = make_problem(read(
      "fields = [\"a\", \"b\"]\nlength = 10.0\npoints = 32\ndiscretisation = \"spectral\"\nparameters = { gamma = 0.1 }\n"
      "H = \"(a_x^2 + b_x^2)/4 - (a^2 + b^2)^2/4\"\nD = { a = \"gamma\", b = \"gamma\" }\n"
      "initial = { a = \"sech(x - 5)\", b = \"0.3*exp(-(x-4)^2)\" }"));
  Simulation simulation(p, {.method = "savf"});
  const double mass = p.initial.squaredNorm();
  for (int n = 0; n < 160; ++n) ASSERT_TRUE(simulation.step(1.0 / 16).solved());
  EXPECT_NEAR(simulation.physical().squaredNorm() / mass, std::exp(-2 * 0.1 * 10), 1e-12);
}

TEST(Custom, FourthDerivativesActOnAWaveByTheFourthPowerOfItsNumber) {
  std::vector<double> errors;
  for (const char* how : {"fd2", "fd4", "spectral"}) {
    for (const int n : {32, 64}) {
      const Problem p = make_problem(
          read(fmt::format("fields = [\"u\"]\nlength = \"2*pi\"\npoints = {}\ndiscretisation = \"{}\"\nH = "
                           "\"u_xx^2/2\"\nS = \"d_x\"\ninitial = {{ u = \"sin(3*x)\" }}",
                           n, how)));
      errors.push_back((p.M.matrix(p.grid) * p.initial - 81 * p.initial).lpNorm<Eigen::Infinity>());
    }
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.1);
  EXPECT_NEAR(std::log2(errors[2] / errors[3]), 4, 0.2);
  EXPECT_LE(errors[4], 1e-8);
  EXPECT_LE(errors[5], 1e-7);
}

TEST(Custom, DampingMayChangeWithTimeAndPlaceOnTheDiagonal) {
  const std::string wave =
      "points = 8\nlength = 2.0\nparameters = { g = 0.3 }\nH = \"v^2/2 + u_x^2/2\"\ninitial = \"zero\"\n";
  const Problem in_time = make_problem(read(wave + "D = { v = \"g + 0.1*sin(t) - 0.02*laplacian\" }"));
  ASSERT_TRUE(in_time.damping.rate);
  EXPECT_NEAR(in_time.damping.rate->value(1.0), 0.3 + 0.1 * std::sin(1.0), 1e-15);
  EXPECT_EQ(in_time.damping.constant(1, 1).identity_part(), 0) << "only the whole rate is known to be ≥ 0";
  const Problem in_place = make_problem(read(wave + "D = { v = \"g*(1 + x)\" }"));
  ASSERT_TRUE(in_place.damping.field_rate);
  std::vector<double> gamma(8);
  in_place.damping.field_rate->values(0, gamma);
  EXPECT_NEAR(gamma[3], 0.6, 1e-15);
  EXPECT_THAT(complaint_of_problem(wave + "D = [[0, \"sin(t)\"], [0, 1]]"),
              HasSubstr("off the diagonal D is constant"));
}

TEST(Custom, OneRateMayBeWrittenInTwoWays) {
  const std::string two = "parameters = { g = 0.1 }\nH = \"p^2/2 + q^4\"\ninitial = { q = 1, p = 0 }\n";
  const Problem p = make_problem(read(two + "D = { q = \"g*(1 + sin(t))\", p = \"sin(t)/10 + 0.1\" }"));
  EXPECT_EQ(p.damping.rate_fields, (std::vector<bool>{true, true}));
  EXPECT_DOUBLE_EQ(p.damping.rate->value(2), 0.1 * (1 + std::sin(2.0)));
  EXPECT_THAT(complaint_of_problem(two + "D = { q = \"g*(1 + sin(t))\", p = \"g*sin(t)\" }"),
              HasSubstr("problem.D has two rates that change"));
}

TEST(Custom, OddDerivativesSayWhichEndsTheyNeed) {
  const std::string fixed = "points = 8\nboundary = \"dirichlet\"\ninitial = \"zero\"\n";
  EXPECT_THAT(complaint_of_problem(fixed + "H = \"v^2/2 + u_x*u\""),
              AllOf(HasSubstr("problem.H = \"v^2/2 + u_x*u\""), HasSubstr("along x needs periodic ends there")));
  EXPECT_THAT(complaint_of_problem(fixed + "H = \"v^2/2 + u^2/2\"\nD = { v = \"d_x\" }"),
              AllOf(HasSubstr("problem.D"), HasSubstr("along x needs periodic ends there")));
}

TEST(Custom, ACaseIsReadBackAsItWasWritten) {
  for (const WrittenCase& written : written_paper_cases()) {
    const RunSpec spec = read(written.problem);
    const std::string text = write_case(spec);
    const RunSpec again = parse_case(text, "again.toml");
    EXPECT_EQ(write_case(again), text);
    EXPECT_EQ(make_problem(again).initial, make_problem(spec).initial);
  }
  const RunSpec example = parse_case(example_case("custom"), "example.toml");
  EXPECT_EQ(make_problem(example).size(), 128);
}

TEST(Custom, ParametersAreKeysThatSetMayOverride) {
  const std::string text = "parameters = { k = \"1/2\" }\nH = \"p^2/2 + k*q^4\"\ninitial = { q = \"k\", p = 0 }";
  EXPECT_DOUBLE_EQ(make_problem(read(text)).potential->value(std::vector<double>{1.0}), 0.5);
  const Problem p = make_problem(read(text, {"problem.k=2"}));
  EXPECT_DOUBLE_EQ(p.potential->value(std::vector<double>{1.0}), 2.0);
  EXPECT_DOUBLE_EQ(p.initial[0], 2.0);
  EXPECT_THAT(read("parameters = { k = 1, m = 2 }\nH = \"p^2/2 + k*q^4\"\ninitial = \"zero\"").notes,
              ::testing::Contains(HasSubstr("no formula names the parameter m")));
}

TEST(Custom, EveryCaseFileHasAFolderOfItsOwn) {
  const std::string text = "[problem]\nname = \"custom\"\nH = \"p^2/2 + q^4\"\ninitial = { q = 1, p = 0 }\n";
  EXPECT_EQ(parse_case(text, "cases/wells.toml").output_directory, "out/wells");
  EXPECT_EQ(parse_case("[problem]\nname = \"oscillator\"\n", "cases/wells.toml").output_directory, "out/oscillator");
}

TEST(Custom, ParametersDoNotTakeThePlaceOfFieldsAndTheirDerivatives) {
  EXPECT_THAT(complaint_of_problem("parameters = { u = 0.3 }\nH = \"p^2/2 + u*q^2/2\"\ninitial = { q = 1, p = 0 }\n"
                                   "friction = { kind = \"position\", coefficient = \"u\" }"),
              HasSubstr("u is the coordinate here, and a parameter of that name is not"));
  const std::string wave = "points = 8\ninitial = \"zero\"\nH = \"v^2/2 + u_x^2/2\"\n";
  EXPECT_THAT(complaint_of_problem(wave + "parameters = { u_x = 4 }"),
              HasSubstr("u_x is a derivative or difference of a field"));
  EXPECT_THAT(complaint_of_problem(wave + "parameters = { du = 4 }"),
              HasSubstr("du is a derivative or difference of a field"));
  for (const char* fields : {"[\"u_x\", \"u\"]", "[\"u\", \"u_x\"]"})
    EXPECT_THAT(complaint_of_problem(fmt::format("points = 8\ninitial = \"zero\"\nfields = {}\nH = \"u^2/2\"", fields)),
                HasSubstr("problem.fields: u_x is a derivative or difference of a field"));
}

TEST(Custom, ThirtyTwoOscillatorsWithoutAGridRunByThemselves) {
  std::string fields, H = "0", initial;
  for (int k = 0; k < 64; ++k) {
    const bool is_momentum = k >= 32;
    const std::string name = fmt::format("{}{}", is_momentum ? "p" : "q", k % 32);
    fields += fmt::format("{}\"{}\"", k == 0 ? "" : ", ", name);
    initial += fmt::format("{}{} = {}", k == 0 ? "" : ", ", name, is_momentum ? 0.0 : 0.1 * k);
    H += is_momentum ? fmt::format(" + {}^2/2", name) : k > 0 ? fmt::format(" + 1 - cos({} - q{})", name, k - 1) : "";
  }
  const Problem p =
      make_problem(read(fmt::format("fields = [{}]\nH = \"{}\"\ninitial = {{ {} }}", fields, H, initial)));
  for (const char* method : {"egc4", "crkn6"}) {
    const RunReport report = solve(p, {.method = method, .h = 0.1, .t_end = 1}).report;
    EXPECT_EQ(report.status, RunReport::Status::success) << method << ": " << report.message;
    EXPECT_EQ(report.law, LawVerdict::holds) << method;
  }
}

TEST(Custom, ForcesThatAreInfiniteAreRefusedWithTheirTime) {
  const auto refusal = [](const char* force, double t_end) {
    const Problem p =
        make_problem(read(fmt::format("H = \"p^2/2 + q^4\"\ninitial = {{ q = 1, p = 0 }}\nforce = \"{}\"", force)));
    return test::error_of([&] { require_finite_rates(p, 0, t_end); });
  };
  for (const char* force : {"1/t", "1/(t-t)", "sqrt(-1-t)"})
    EXPECT_THAT(refusal(force, 1),
                AllOf(HasSubstr("the force "), HasSubstr(" on the field p is no finite number at t = 0")));
  EXPECT_THAT(refusal("1/(t-0.5)^2", 1), HasSubstr("is infinite between t = 0."));
  EXPECT_THAT(refusal("sqrt(0.5-t)", 1), HasSubstr("ceases to be a real number between t = 0.5"));
  EXPECT_EQ(refusal("1/(t-0.5)^2", 0.4), "");
}

TEST(Custom, TheEnergyLawHoldsWithPowersOfThePlaceInV) {
  const Problem p = make_problem(
      read("points = 16\nlength = 2.0\nH = \"v^2/2 + u_x^2/2 + u^4/(1 + x)\"\ninitial = { u = \"sin(pi*x)\", v = 0 }"));
  for (const char* method : {"seidm", "seilm", "egc4"}) {
    Simulation simulation(p, {.method = method});
    const double before = simulation.energy().H;
    for (int n = 0; n < 100; ++n) ASSERT_TRUE(simulation.step(1.0 / 64).solved());
    EXPECT_NEAR(simulation.energy().H, before, 1e-11 * before) << method;
  }
}

// Formulas are tried on a few points first, where 1/(x − 5) may have its pole, and the grid of the case has none.
TEST(Custom, APoleBetweenThePointsOfAGridIsAccepted) {
  const std::string wave = "length = 10.0\nH = \"v^2/2 + u_x^2/2\"\nD = { v = \"1/(x - 5)^2\" }\ninitial = \"zero\"\n";
  EXPECT_EQ(complaint_of_problem(wave + "points = 63"), "");
  EXPECT_THAT(complaint_of_problem(wave + "points = 64"), HasSubstr("is inf at t = 0 at x = 5 (j = 32)"));
}

TEST(Custom, FrictionAndForcesMayNameTheParameters) {
  const std::string text =
      "parameters = { c = 0.5, F = 2 }\nH = \"p^2/2 + q^4\"\ninitial = { q = 0, p = 1 }\n"
      "friction = { kind = \"quadratic\", coefficient = \"c/2\" }\nforce = \"F*cos(t)\"";
  const RunSpec spec = read(text);
  EXPECT_TRUE(spec.notes.empty());
  const Problem p = make_problem(spec);
  std::vector<double> r(1), f(1);
  p.friction->force(0, std::vector<double>{0.0}, std::vector<double>{2.0}, r);
  EXPECT_DOUBLE_EQ(r[0], 0.25 * 4);
  p.forces[1]->values(0, f);
  EXPECT_DOUBLE_EQ(f[0], 2);
  EXPECT_EQ(write_case(parse_case(write_case(spec), "again.toml")), write_case(spec));
}

TEST(Custom, AMistakeIsSaidAtItsKeyWithThePlaceInTheFormula) {
  const std::string start = "initial = { q = 1, p = 0 }\n";
  EXPECT_THAT(complaint_of_problem(start + "H = \"p^2/2 + r^4\""),
              AllOf(StartsWith("x.toml:4:5: problem.H: formula, column 9: unknown name 'r'"), HasSubstr("Allowed: ")));
  EXPECT_THAT(complaint_of_problem(start + "H = \"p^2/2 + sin(q, 2)\""), HasSubstr("sin takes 1 argument, not 2"));
  EXPECT_THAT(complaint_of_problem(start + "H = \"p^2/2 + 1/(q - 1)\""),
              AllOf(HasSubstr("the force of V on q is"), HasSubstr("where q = 1")));
  EXPECT_THAT(complaint_of_problem(start + "H = \"p^2/2 + sqrt(q - 3)\""), HasSubstr("the force of V on q is"));
  EXPECT_THAT(complaint_of_problem(start + "H = \"p^2/2 + max(q, 0)\""),
              AllOf(HasSubstr("formula, column 9"), HasSubstr("max has no derivative, and forces are derivatives")));
  EXPECT_THAT(complaint_of_problem(start + "H = \"p^2/2\"\nV = \"q^4\""), HasSubstr("H is the whole energy"));
  EXPECT_THAT(complaint_of_problem(start), HasSubstr("[problem] has no energy"));
  EXPECT_THAT(complaint_of_problem("H = \"p^2/2 + q^2\""), HasSubstr("no initial state"));
  EXPECT_THAT(complaint_of_problem("fields = [\"a\", \"b\", \"c\"]\nH = \"a^2\"\ninitial = { a = 1, b = 0 }"),
              HasSubstr("S is not given, and [[0, I], [−I, 0]] needs coordinates and as many momenta"));
  EXPECT_THAT(complaint_of_problem("fields = [\"a\", \"a\"]\nH = \"a^2\"\ninitial = \"zero\""),
              HasSubstr("a is named twice"));
  EXPECT_THAT(complaint_of_problem("fields = [\"a\", \"pi\"]\nH = \"a^2\"\ninitial = \"zero\""),
              HasSubstr("the name pi stands for something else"));
  EXPECT_THAT(complaint_of_problem(start + "H = \"p^2/2 + V(q)\""),
              HasSubstr("unknown function 'V': write out what V( ) is, or V*( ) for a product. Allowed: sin, cos"));
  EXPECT_THAT(complaint_of_problem(start + "H = \"p^2/2\"\ngamma = 0.1"), HasSubstr("did you mean 'D'?"));
  EXPECT_THAT(complaint_of_problem("points = 8\nH = \"v^2/2 + u_x^4\"\ninitial = \"zero\""),
              HasSubstr("derivatives stand in quadratic terms only"));
  EXPECT_THAT(complaint_of_problem("points = 8\nH = \"v^2/2 + du^3*u\"\ninitial = \"zero\""),
              HasSubstr("mixes a difference between neighbours with what belongs to one point"));
  EXPECT_THAT(complaint_of_problem("points = 8\nH = \"v^2/2\"\nS = [[0, 1], [-1]]\ninitial = \"zero\""),
              HasSubstr("problem.S must have 2 rows of 2 entries"));
  EXPECT_THAT(complaint_of_problem("points = 8\nH = \"v^2/2\"\nD = { w = 1 }\ninitial = \"zero\""),
              HasSubstr("unknown field in problem.D 'w'"));
  EXPECT_THAT(complaint_of_problem("points = 8\nH = \"v^2/2\"\nD = { v = \"d_x^5\" }\ninitial = \"zero\""),
              HasSubstr("derivatives are there up to the fourth"));
  EXPECT_THAT(complaint_of_problem(start + "parameters = { boundary = 1 }\nH = \"p^2/2\""),
              HasSubstr("the name boundary is taken by a key of [problem]"));
  EXPECT_THAT(complaint_of_problem(start + "H = \"p^2/2 + 0^q\""), HasSubstr("0^(q) has no derivative"));
  EXPECT_THAT(complaint_of_problem("points = 8\nH = \"v^2/2\"\nHH = 1\ninitial = \"zero\""),
              HasSubstr("unknown key in [problem] custom 'HH'"));
}

TEST(Custom, ATodaRingKeepsItsEnergyAndMomentumWithoutDamping) {
  const Problem p = make_problem(read(
      "points = 8\nlength = 8.0\nH = \"v^2/2 + exp(-du) + du - 1\"\ninitial = { u = \"0.5*sin(2*pi*x/8)\", v = \"0.2\" }"));
  Simulation simulation(p, {.method = "avf"});
  const double before = simulation.energy().H;
  for (int n = 0; n < 200; ++n) ASSERT_TRUE(simulation.step(0.1).solved());
  EXPECT_NEAR(simulation.energy().H, before, 1e-11);
  EXPECT_NEAR(simulation.physical().tail(8).sum(), 1.6, 1e-12);
}

// A soliton leaves the masses behind it displaced, which ends that are fixed would answer with a second wave.
TEST(Custom, ATodaSolitonCrossesAChainWithFreeEnds) {
  const double k = 1.0, speed = std::sinh(k) / k, start = 20, t = 16;
  const Problem p = make_problem(read(
      fmt::format("length = 64.0\npoints = 64\nboundary = \"neumann\"\nparameters = {{ k = {}, c = {} }}\n"
                  "H = \"v^2/2 + exp(-du) + du - 1\"\ninitial = {{ u = \"log(cosh(k*(x - c))/cosh(k*(x + 1 - c)))\", "
                  "v = \"sinh(k)*(tanh(k*(x + 1 - c)) - tanh(k*(x - c)))\" }}",
                  k, start)));
  const Solution s = solve(p, {.method = "egc6", .h = 1.0 / 16, .t_end = t});
  const double c = start + speed * t;
  for (Index j = 0; j < 64; ++j) {
    const double x = p.grid.coordinate(j, 0);
    EXPECT_NEAR(s.z[s.z.size() - 128 + static_cast<std::size_t>(j)],
                std::log(std::cosh(k * (x - c)) / std::cosh(k * (x + 1 - c))), 1e-7)
        << x;
  }
}

// The number of a point is x/dx, or half of one more where the first point lies half a cell inside.
TEST(Custom, FormulasOnALineNameTheNumberOfAPoint) {
  for (const char* boundary : {"periodic", "dirichlet", "neumann"}) {
    const Problem p = make_problem(
        read(fmt::format("length = 3.0\npoints = 7\nboundary = \"{}\"\nH = \"v^2/2 + j*u^4\"\nD = {{ v = \"j/10\" }}\n"
                         "force = {{ v = \"j^2\" }}\ninitial = {{ u = \"1\", v = \"j\" }}",
                         boundary)));
    const Index n = p.grid.unknowns();
    std::vector<double> gradient(static_cast<std::size_t>(n)), rates = gradient, forces = gradient;
    p.potential->value_and_gradient({p.initial.data(), gradient.size()}, gradient);
    p.damping.field_rate->values(0, rates);
    p.forces[1]->values(0, forces);
    for (Index j = 0; j < n; ++j) {
      const auto at = static_cast<std::size_t>(j);
      EXPECT_DOUBLE_EQ(p.initial[n + j], static_cast<double>(j + 1));
      EXPECT_NEAR(gradient[at], 4 * static_cast<double>(j + 1), 1e-13) << boundary;
      EXPECT_NEAR(rates[at], static_cast<double>(j + 1) / 10, 1e-14) << boundary;
      EXPECT_NEAR(forces[at], square(static_cast<double>(j + 1)), 1e-12) << boundary;
    }
  }
  // x/dx is not always whole, and j is.
  for (int points = 4; points < 70; points += 3) {
    const std::string line = fmt::format("length = 0.7\npoints = {}\nH = \"v^2/2 + u^4\"\n", points);
    for (int n = 1; n <= points; n += 1 + points / 8) {
      const Problem p = make_problem(read(
          line +
          fmt::format("force = {{ v = \"step(j - {0})\" }}\ninitial = {{ u = \"step(j - {0})\", v = \"0\" }}", n)));
      std::vector<double> force(static_cast<std::size_t>(points));
      p.forces[1]->values(0, force);
      for (Index i = 0; i < points; ++i)
        ASSERT_EQ(force[static_cast<std::size_t>(i)], p.initial[i]) << points << " " << n;
    }
  }
  const Problem chain = make_problem(
      parse_case("[problem]\nname = \"chain\"\npoints = 6\nboundary = \"neumann\"\nforce = { p = \"j\" }\n", "x.toml"));
  std::vector<double> force(6);
  chain.forces[1]->values(0, force);
  EXPECT_EQ(force[5], 6);
  EXPECT_THAT(complaint_of_problem("length = [1.0, 1.0]\npoints = 7\nH = \"v^2/2 + j*u^4\"\ninitial = \"zero\""),
              HasSubstr("j, the number of a point, stands in formulas on a line and in initial"));
  EXPECT_THAT(complaint_of_problem("length = 1.0\npoints = 7\nH = \"v^2/2\"\nM = \"j\"\ninitial = \"zero\""),
              HasSubstr("problem.M"));
}

// u_{N+1} = u_1 + a: positions are aj/N + u with a displacement u, which closes the ring.
TEST(Custom, AShiftedRingIsWrittenByDisplacements) {
  const Problem p = make_problem(
      read("length = 5.0\npoints = 5\nparameters = { a = 3.0 }\n"
           "H = \"v^2/2 + (du + a/points)^4 + cos(u + a*x/length)\"\ninitial = { u = \"sin(x)\", v = \"0\" }"));
  const Vector u = p.initial.head(5);
  std::vector<double> position, gradient(5), expected(5);
  for (Index j = 0; j < 6; ++j) position.push_back(u[j % 5] + 3.0 * static_cast<double>(j + 1) / 5);
  double V = 0;
  for (std::size_t j = 0; j < 5; ++j) {
    const double stretch = position[j + 1] - position[j];
    V += std::pow(stretch, 4) + std::cos(position[j]);
    expected[j] -= 4 * std::pow(stretch, 3) + std::sin(position[j]);
    expected[(j + 1) % 5] += 4 * std::pow(stretch, 3);
  }
  EXPECT_NEAR(p.potential->value_and_gradient({u.data(), 5}, gradient), V, 1e-13);
  for (std::size_t j = 0; j < 5; ++j) EXPECT_NEAR(gradient[j], expected[j], 1e-13) << j;
}

TEST(CustomCase, AFormulaThatCannotBeReadIsSaidAtItsKeyAlsoByOverride) {
  const std::string start = "parameters = { k = 2.0 }\nH = \"p^2/2 + k*q^4\"\ninitial = { q = 1, p = 0 }";
  const auto refused = [&](const std::string& override) { return error_of([&] { read(start, {override}); }); };
  EXPECT_THAT(refused("problem.H=p^2/2+k*q**2"),
              AllOf(StartsWith("--set problem.H=p^2/2+k*q**2: problem.H: formula, column "), HasSubstr("^, not **")));
  EXPECT_THAT(refused("problem.D={p=\"2**t\"}"), HasSubstr("problem.D, row 2, column 2: formula, column 2"));
  EXPECT_THAT(error_of([&] { read("parameters = { k = 2.0 }\nH = \"p^2/2 + k*q**4\"\ninitial = \"zero\""); }),
              StartsWith("x.toml:4:5: problem.H: formula"));
}

TEST(CustomCase, AFewDegreesOfFreedomHaveNoPlaceInSentences) {
  const std::string said = complaint_of_problem("H = \"p^2/2 + 1/(q - 1)\"\ninitial = { q = 1, p = 0 }");
  EXPECT_THAT(said, HasSubstr("at the initial state, where q = 1, p = 0"));
  EXPECT_THAT(said, testing::Not(HasSubstr("x = ")));
  EXPECT_THAT(said, testing::Not(HasSubstr("j = ")));
  EXPECT_THAT(complaint_of_problem("points = 8\nH = \"v^2/2 + 1/(u - 1)\"\ninitial = { u = 1, v = 0 }"),
              HasSubstr("x = 0.125 (j = 1)"));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
