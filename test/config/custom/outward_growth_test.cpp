// Which energies are seen to fall as their fields shrink, and which laws follow.
#include <seiche/config/case/case_file.hpp>
#include <seiche/law/law.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

using ::testing::HasSubstr;

Problem made(const std::string& H, const std::string& rest = "") {
  return make_problem(parse_case("[problem]\nname = \"custom\"\ninitial = \"zero\"\nH = \"" + H + "\"\n" + rest +
                                     "\n[time]\nend = 10\n",
                                 "x.toml"));
}

// The smallest u·∇V(u) at random u of many sizes.
double smallest_growth(const PointwisePotential& V) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto n = static_cast<std::size_t>(V.fields());
  double smallest = 0;
  for (int i = 0; i < 4000; ++i) {
    std::vector<double> u(n), gradient(n);
    for (double& x : u) x = std::pow(10.0, i % 5 - 3) * normal(random);
    V.gradient(u, gradient);
    double growth = 0, size = 0;
    for (std::size_t f = 0; f < n; ++f) {
      growth += u[f] * gradient[f];
      size += std::abs(u[f] * gradient[f]);
    }
    EXPECT_TRUE(std::isfinite(growth));
    smallest = std::min(smallest, growth + 1e-12 * size);
  }
  return smallest;
}

TEST(OutwardGrowth, EvenAndConvexEnergiesAreSeenToFallAsTheirFieldsShrink) {
  for (const char* H : {"p^2/2 + q^4", "p^2/2 + q^6/3 + q^4", "p^2/2 + sqrt(1 + q^2)", "p^2/2 + cosh(2*q) - 1",
                        "p^2/2 + 1 - sech(q)", "p^2/2 + log(1 + q^4)", "p^2/2 + exp(q) - q", "p^2/2 + exp(-2*q) + 2*q",
                        "p^2/2 - exp(-q^2)", "p^2/2 + log(cosh(q))", "p^2/2 + q^2/(1 + 0*q) + q^4*cosh(q)",
                        "p^2/2 + sqrt(1 + q^2)*q^2", "p^4/4 + q^4/4", "sqrt(1 + p^2) + q^4", "p^2/2 + (1 + q^2)^1.5"}) {
    const Problem p = made(H);
    ASSERT_TRUE(p.potential) << H;
    EXPECT_TRUE(p.potential->grows_outward()) << H;
    EXPECT_GE(smallest_growth(*p.potential), 0) << H;
  }
}

TEST(OutwardGrowth, EnergiesThatCanRiseAsTheirFieldsShrinkAreNotTakenForOthers) {
  for (const char* H :
       {"p^2/2 - q^4", "p^2/2 + q^4/4 - q^3", "p^2/2 + 1 - cos(q)", "p^2/2 + exp(q)", "p^2/2 + (q - 1)^4",
        "p^2/2 + sech(q)", "p^2/2 - sqrt(1 + q^2)", "p^2/2 + exp(-q^2)", "p^2/2 + cosh(q - 1)",
        "p^2/2 + sqrt(1 + (q - 2)^2)", "p^2/2 + q^4*sin(q)", "p^2/2 + 1/(1 + q^2)", "p^3/3 + q^4"}) {
    const Problem p = made(H);
    ASSERT_TRUE(p.potential) << H;
    EXPECT_FALSE(p.potential->grows_outward()) << H;
    EXPECT_LT(smallest_growth(*p.potential), 0) << H << ": the test would prove nothing";
  }
}

// Multiplied out, it has millions of terms.
TEST(OutwardGrowth, APowerOfASumIsJudgedAsItStands) {
  const std::string line = "fields = [\"u\", \"v\"]\nlength = 2.0\npoints = 4\n";
  EXPECT_FALSE(made("(u + v + x + (u + v + x + 2)^2)^16", line).potential->grows_outward());
}

TEST(OutwardGrowth, PlacesAreCoefficientsWhoseSignCounts) {
  const std::string line = "length = 1.0\npoints = 8\n";
  EXPECT_TRUE(made("v^2/2 + (1 + x^2)*u^4", line).potential->grows_outward());
  EXPECT_TRUE(made("v^2/2 + exp(-x)*u^4", line).potential->grows_outward());
  EXPECT_FALSE(made("v^2/2 + (x - 0.5)*u^4", line).potential->grows_outward());
  EXPECT_TRUE(made("v^2/2 + exp(-du) + du - 1", line).potential->grows_outward()) << "of bonds, a Toda lattice";
}

TEST(OutwardGrowth, ALawIsPromisedWhereOneRateShrinksAllThatVDependsOn) {
  const auto law = [](const std::string& H, const std::string& D) {
    return promise_energy_law(made(H, "D = " + D), 10.0);
  };
  EXPECT_TRUE(law("p^4/4 + q^2/2", "{ p = 0.1 }").promised);
  EXPECT_TRUE(law("sqrt(1 + p^2) + q^2/2", "{ p = \"0.1 + 0.05*sin(t)\" }").promised);
  EXPECT_TRUE(law("p^2/2 + q^4/4", "{ q = 0.1, p = 0.2 }").promised);
  EXPECT_TRUE(law("p^2/2 + q^4/4", "{ q = 0.1 }").promised);
  EXPECT_FALSE(law("p^2/2 - q^4/4", "{ q = 0.1 }").promised);
  EXPECT_FALSE(law("p^2/2 + (p - q)^4", "{ p = 0.1 }").promised) << "only one of two shrinks";
  EXPECT_FALSE(law("p^2/2 + (p - q)^4", "{ q = 0.1, p = 0.2 }").promised) << "at different rates";
  EXPECT_THAT(law("p^2/2 - q^4/4", "{ q = 0.1 }").reason, HasSubstr("the form of V does not show that it falls"));
}

// The kinetic energy of a double pendulum is ½pᵀA(q)p with A ⪰ 0 for every q, if `coupling` is at most √2 there:
// friction on the momenta takes p·∂H/∂p = pᵀA(q)p per unit of its rate.
Problem double_pendulum(const std::string& coupling, const std::string& D) {
  return made("(p^2 + 2*r^2 - 2*" + coupling + "*p*r*cos(a - b))/(2*(1 + sin(a - b)^2)) + 3 - 2*cos(a) - cos(b)",
              "fields = [\"a\", \"b\", \"p\", \"r\"]\nD = " + D);
}

TEST(OutwardGrowth, FrictionOnMomentaOfAMovingMassIsSeenToTakeEnergy) {
  const LawPromise law = promise_energy_law(double_pendulum("1", "{ p = 0.1, r = 0.1 }"), 10);
  EXPECT_TRUE(law.promised) << law.reason;
  EXPECT_THAT(law.reason, HasSubstr("v·∂V/∂v ≥ 0"));
  EXPECT_TRUE(promise_energy_law(double_pendulum("1.4", "{ p = 0.1, r = 0.1 }"), 10).promised);
  EXPECT_FALSE(promise_energy_law(double_pendulum("1.5", "{ p = 0.1, r = 0.1 }"), 10).promised)
      << "A is indefinite at q = 0";
  EXPECT_FALSE(promise_energy_law(double_pendulum("1", "{ p = 0.1 }"), 10).promised) << "r·∂H/∂p may have any sign";
  EXPECT_FALSE(promise_energy_law(double_pendulum("1", "{ p = 0.1, r = 0.2 }"), 10).promised) << "two rates";
  EXPECT_FALSE(promise_energy_law(double_pendulum("1", "{ b = 0.1, p = 0.1, r = 0.1 }"), 10).promised)
      << "b may be moved uphill";
  EXPECT_TRUE(
      promise_energy_law(made("p^2/(2 + cos(q)) + 1 - cos(q)", "D = { p = \"0.1 + 0.05*sin(t)\" }"), 10).promised);
  EXPECT_FALSE(promise_energy_law(made("p^2/(1 + 2*cos(q)) + 1 - cos(q)", "D = { p = 0.1 }"), 10).promised)
      << "a mass that changes sign";
  EXPECT_FALSE(promise_energy_law(made("(p^2 + p^3)/(2 + cos(q)) + 1 - cos(q)", "D = { p = 0.1 }"), 10).promised)
      << "of another degree";
}

}  // namespace TEST_FILE
}  // namespace seiche::test
