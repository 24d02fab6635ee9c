// Linear parts by functions of the wave number: what they do to waves, and what cannot be one.
#include <test/support/error_of.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/config/custom/operator_formula.hpp>
#include <seiche/simulation/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double pi = std::numbers::pi;
constexpr Boundary ring = Boundary::periodic;

Grid grid_of(const std::vector<GridAxis>& axes) { return Grid{.axes = axes}; }

Stencil entry(const std::string& text, const Grid& grid) {
  return compile_operator("problem.M", text, grid, grid.dimension(), Discretisation::spectral, {}, false).stencil;
}

const std::vector<Grid>& grids() {
  static const std::vector<Grid> all = {grid_of({{8, 2.0, ring}}),
                                        grid_of({{9, 3.0, ring}}),
                                        grid_of({{7, 1.5, Boundary::dirichlet}}),
                                        grid_of({{6, 2.5, Boundary::neumann}}),
                                        grid_of({{6, 2.0, ring}, {5, 3.0, ring}}),
                                        grid_of({{6, 2.0, ring}, {5, 3.0, Boundary::dirichlet}}),
                                        grid_of({{4, 2.0, ring}, {3, 3.0, ring}, {4, 1.0, ring}})};
  return all;
}

TEST(WaveNumber, SquaresAreDerivativesOnEveryKindOfGrid) {
  for (const Grid& grid : grids()) {
    const Stencil by_waves = entry("2 + 3*k^2 + k_x^4", grid);
    const Stencil by_derivatives = entry("2 - 3*laplacian + d_x^4", grid);
    const Modes modes(grid);
    for (Index k = 0; k < modes.count(); ++k) {
      const std::complex<double> expected = by_derivatives.symbol(modes[k]);
      EXPECT_LE(std::abs(by_waves.symbol(modes[k]) - expected), 1e-13 * std::abs(expected));
    }
    const Eigen::MatrixXd expected = by_derivatives.matrix(grid);
    EXPECT_LE((by_waves.matrix(grid) - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff());
  }
}

TEST(WaveNumber, FunctionsBesideAnOddDerivativeAreOdd) {
  for (const Grid& grid : {grids()[0], grids()[1]}) {
    const Stencil third = entry("d_x*k^2", grid);
    const Eigen::MatrixXd expected = -1 * entry("d_x^3", grid).matrix(grid);
    EXPECT_LE((third.matrix(grid) - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff());
    EXPECT_FALSE(third.is_symmetric());
  }
}

TEST(WaveNumber, AMatrixHasTheModesAsItsVectors) {
  // On cos(κ·x) of a rectangle, with a symbol that is no product of functions of κ_x and κ_y.
  const Grid grid = grid_of({{6, 2.0, ring}, {5, 3.0, ring}});
  const double kx = pi, ky = 4 * pi / 3;
  const auto wave = [&](double phase) {
    Vector u(grid.unknowns());
    for (Index i = 0; i < u.size(); ++i)
      u[i] = std::cos(kx * grid.coordinate(i, 0) + ky * grid.coordinate(i, 1) + phase);
    return u;
  };
  const Vector sheared = entry("sqrt(1 + k_x*k_y + k^2)", grid).matrix(grid) * wave(0);
  EXPECT_LE((sheared - std::sqrt(1 + kx * ky + kx * kx + ky * ky) * wave(0)).cwiseAbs().maxCoeff(), 1e-13);
  // ∂x/|k| turns by a quarter of the wave.
  const Vector turned = entry("d_x/k", grid).matrix(grid) * wave(0);
  EXPECT_LE((turned - kx / std::hypot(kx, ky) * wave(pi / 2)).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(WaveNumber, AFunctionHasItsLimitOnTheConstantWhateverTheLength) {
  const std::vector<std::pair<std::string, double>> limits = {
      {"sqrt(tanh(k)/k)", 1},         {"sqrt(tanh(1000*k)/k)", std::sqrt(1000.0)},
      {"(1 - exp(-2*k))/k", 2},       {"2*(1 - cos(k))/k^2", 1},
      {"3*(k/tanh(k) - 1)/k^2", 1},   {"log(1 + k^2)/k^2", 1},
      {"(1 - exp(-k^2))/k^2", 1},     {"3/k^2 - 3/(k*tanh(k)) + 2", 1},
      {"1 + tanh(k)^2/k", 1},         {"1 + k*(1/tanh(k) - 1/k)", 1},
      {"1 + k^2*log(k)", 1},          {"1 - laplacian*k^(-0.5)", 1},
      {"(exp(k_x) + exp(-k_x))/2", 1}};
  for (const double length : {0.01, 0.3, 2 * pi, 100.0, 1e4, 1e6}) {
    const Grid grid = grid_of({{4, length, ring}});
    for (const auto& [text, limit] : limits) {
      const bool overflows = text.find("exp(k_x)") != std::string::npos && 4 * pi / length > 700;
      if (!overflows) {
        EXPECT_NEAR(entry(text, grid).symbol(Modes(grid)[0]).real(), limit, 1e-8 * limit) << text << " on " << length;
      }
    }
  }
}

// ±κ of the highest wave number are one mode: what is odd in it vanishes there.
TEST(WaveNumber, TheHighestWaveNumberTakesTheMeanOverBothSigns) {
  const Grid line = grids()[0];
  EXPECT_EQ(entry("d_x*k^2", line).symbol(Modes(line)[4]), 0.0);
  EXPECT_NE(entry("k^2", line).symbol(Modes(line)[4]), 0.0);

  const Grid plane = grid_of({{4, 2.0, ring}, {6, 3.0, ring}});
  const Eigen::MatrixXd mixed = entry("d_x", plane).matrix(plane) * entry("d_y", plane).matrix(plane);
  EXPECT_LE((entry("-k_x*k_y", plane).matrix(plane) - mixed).cwiseAbs().maxCoeff(),
            1e-12 * mixed.cwiseAbs().maxCoeff());
  const Modes modes(plane);
  for (Index k = 0; k < modes.count(); ++k)
    EXPECT_LE(std::abs(entry("-k_x*k_y", plane).symbol(modes[k]) -
                       entry("d_x", plane).symbol(modes[k]) * entry("d_y", plane).symbol(modes[k])),
              1e-12);
}

TEST(WaveNumber, BetweenEndsThatHoldTheFieldNoModeIsConstant) {
  const Grid held = grids()[2];
  const Eigen::MatrixXd inverse = entry("1/k^2", held).matrix(held);
  const Eigen::MatrixXd identity = -1 * entry("laplacian", held).matrix(held) * inverse;
  EXPECT_LE((identity - Eigen::MatrixXd::Identity(held.unknowns(), held.unknowns())).cwiseAbs().maxCoeff(), 1e-12);
}

std::string whitham(const std::string& more) {
  return "[problem]\nname = \"custom\"\nfields = [\"u\"]\nlength = 20.0\npoints = 64\ndiscretisation = \"spectral\"\n"
         "parameters = { gamma = 0.1 }\nS = \"-d_x\"\nM = \"sqrt(tanh(k)/k)\"\nD = \"gamma\"\n"
         "initial = { u = \"0.5 + cos(0.6*pi*x)\" }\n" +
         more;
}

// u = e^{−γt} (½ + cos κ(x − c t)) with Whitham's speed c = √(tanh κ/κ).
TEST(WaveNumber, WavesTravelAtTheSpeedOfTheFormulaWhateverTheStep) {
  for (const char* backend : {"modal", "dense"}) {
    for (const char* method : {"seisav", "egc4", "etdrk4"}) {
      const RunSpec spec = parse_case(whitham("[method]\nname = \"egc4\"\nh = 0.5\n[time]\nend = 10\n"), "x.toml", {});
      const Problem problem = make_problem(spec);
      Simulation simulation(problem, {.method = method, .backend = backend});
      for (int n = 0; n < 20; ++n) ASSERT_TRUE(simulation.step(0.5).solved());
      const double kappa = 0.6 * pi, speed = std::sqrt(std::tanh(kappa) / kappa), t = 10;
      Vector expected(problem.size());
      for (Index i = 0; i < expected.size(); ++i)
        expected[i] = std::exp(-0.1 * t) * (0.5 + std::cos(kappa * (problem.grid.coordinate(i, 0) - speed * t)));
      EXPECT_LE((simulation.physical() - expected).cwiseAbs().maxCoeff(), 1e-12) << backend << " " << method;
    }
  }
}

TEST(WaveNumber, BackendsAgreeOnAFractionalEquationInThePlane) {
  const std::string text = R"toml([problem]
name = "custom"
length = [6.0, 5.0]
points = [8, 6]
discretisation = "spectral"
parameters = { nu = 0.2 }
M = [["1 + k^1.5", 0], [0, 1]]
V = "u^4/4"
D = { v = "nu*k^0.5" }
initial = { u = "sin(pi*x/3)*cos(2*pi*y/5)", v = "cos(pi*x/3)" }
[method]
name = "seilm"
h = 0.1
[time]
end = 2
)toml";
  const Problem problem = make_problem(parse_case(text, "x.toml", {}));
  for (const char* method : {"seilm", "egc6"}) {
    Vector states[2];
    const char* backends[] = {"modal", "dense"};
    for (int b = 0; b < 2; ++b) {
      Simulation simulation(problem, {.method = method, .backend = backends[b]});
      for (int n = 0; n < 20; ++n) ASSERT_TRUE(simulation.step(0.1).solved());
      states[b] = simulation.physical();
    }
    EXPECT_LE((states[0] - states[1]).cwiseAbs().maxCoeff(), 1e-12) << method;
    EXPECT_GT(states[0].norm(), 0.1);
  }
}

TEST(WaveNumber, AParameterMayBeCalledK) {
  const Grid grid = grid_of({{8, 2.0, ring}});
  const OperatorFormula spring = compile_operator("problem.M", "k", grid, 1, Discretisation::fd2, {{"k", 3.0}}, false);
  EXPECT_EQ(spring.stencil.factor_of_identity(), 3.0);
}

TEST(WaveNumber, AMistakeIsSaidWithTheTermAndTheWaveNumber) {
  const Grid line = grids()[0], plane = grids()[4], strip = grids()[5];
  const auto complaint = [](const std::string& text, const Grid& grid, bool may_vary = false) {
    return error_of(
        [&] { compile_operator("problem.M", text, grid, grid.dimension(), Discretisation::spectral, {}, may_vary); });
  };
  EXPECT_THAT(complaint("1 + 1/k", line),
              AllOf(HasSubstr("problem.M = \"1 + 1/k\""), HasSubstr("inf at k = 0, and no limit there was found")));
  EXPECT_THAT(complaint("log(k)", line), HasSubstr("no limit there was found"));
  EXPECT_THAT(complaint("k_x^2/k^2", plane), HasSubstr("from one side it is 1 there, from another 0"));
  EXPECT_THAT(complaint("2 + k_x*k_y*(k_x - k_y)^2/k^4", plane), HasSubstr("from one side it is 0 there"));
  EXPECT_THAT(complaint("1 + k_x", line), AllOf(HasSubstr("k_x = 3.14159"), HasSubstr("abs(k_x)")));
  EXPECT_THAT(complaint("d_x*k_x", line), HasSubstr("an even function"));
  EXPECT_THAT(complaint("k_x^1.5", grids()[1]), AllOf(HasSubstr("3.03"), HasSubstr("nan at k_x = -2.0944")));
  EXPECT_THAT(complaint("sqrt(4 - k^2)", line), HasSubstr("nan at k_x = "));
  EXPECT_THAT(complaint("k_x*k_y", strip), HasSubstr("between ends"));
  EXPECT_THAT(complaint("d_x*sqrt(k)", strip), HasSubstr("periodic along every axis"));
  EXPECT_THAT(complaint("x*k^2", line, true), HasSubstr("beside t or a place"));
  EXPECT_THAT(complaint("sqrt(-d_x^2)", line), HasSubstr("wave numbers k_x and k"));
  EXPECT_THAT(complaint("d_x*d_y", plane), HasSubstr("d_x*d_y is -k_x*k_y"));
  EXPECT_THAT(error_of([&] { compile_operator("problem.M", "k^2", line, 1, Discretisation::fd2, {}, false); }),
              HasSubstr("discretisation = \"spectral\""));
  EXPECT_THAT(error_of([&] { entry("k^2", line).sparse_matrix(line); }), HasSubstr("no sparse matrix"));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
