// The damping meter: decay and frequency of each mode against closed formulas, on every backend.
#include <test/support/cases.hpp>
#include <test/support/error_of.hpp>
#include <test/support/matrices.hpp>

#include <seiche/core/base/error.hpp>
#include <seiche/core/numerics/eigenpairs.hpp>
#include <seiche/damping/formula_frictions.hpp>
#include <seiche/damping/frictions.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/formula/formula_compiler.hpp>
#include <seiche/problem/chain.hpp>
#include <seiche/problem/gkdv.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/oscillator.hpp>
#include <seiche/study/spectrum.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <cmath>
#include <complex>
#include <map>
#include <sstream>

namespace seiche::test {
namespace TEST_FILE {

using testing::HasSubstr;
using Complex = std::complex<double>;

Problem damped_oscillator(double omega, double gamma) {
  return oscillator({.omega_squared = omega * omega, .alpha = 0.0, .gamma = constant_rate(gamma)});
}

// ρ of half a damping of p, a Hamiltonian substep with rotation angle `angle` about ω, half a damping: a 2 × 2 product.
Complex factor_of_strang(double angle, double gamma, double h) {
  const double decay = std::exp(-gamma * h);  // of det R
  const double trace = (1 + decay) * std::cos(angle);
  return {trace / 2, std::sqrt(decay - trace * trace / 4)};
}

void expect_factor(const SpectrumRow& row, Complex rho, double h, const std::string& of) {
  EXPECT_NEAR(row.numerical_decay, -std::log(std::abs(rho)) / h, 1e-11) << of;
  EXPECT_NEAR(row.numerical_frequency, std::arg(rho) / h, 1e-11) << of;
}

// The same equation, its stencils written out.
Problem by_matrices(const Problem& grid) {
  Problem p = grid;
  p.matrices = std::make_shared<SparseOperators>(SparseOperators{.S = grid.S.sparse_matrix(grid.grid),
                                                                 .M = grid.M.sparse_matrix(grid.grid),
                                                                 .D = grid.damping.constant.sparse_matrix(grid.grid)});
  for (BlockStencil* block : {&p.S, &p.M, &p.damping.constant}) *block = BlockStencil(grid.field_count());
  return p;
}

TEST(Spectrum, HoldsTheLinearPartOfAFriction) {
  const double omega = 2.0, h = 0.25;
  const double expected = 0.3 + 0.4;
  Problem quadratic = damped_oscillator(omega, 0.3);
  quadratic.friction = quadratic_friction(0.4, 0.7);
  Problem formula = damped_oscillator(omega, 0.3);
  formula.friction =
      formula_friction({.formula = compile_formula("0.4*sin(v) + v^3*(1 + u)", {"v", "u", "t", "x", "y", "z"})},
                       formula.grid);
  const auto decay = [&](const Problem& p) {
    const Spectrum s = spectrum(p, {.method = "seavf"}, h);
    EXPECT_EQ(s.rows.size(), 1U);
    return s.rows[0].exact_decay;
  };
  EXPECT_NEAR(decay(quadratic), expected / 2, 1e-14);
  EXPECT_NEAR(decay(formula), expected / 2, 1e-14);
  Problem cubic = damped_oscillator(omega, 0.3);  // no linear part
  cubic.friction = cubic_friction(1.0);
  EXPECT_NEAR(decay(cubic), 0.3 / 2, 1e-14);
  Problem dry = damped_oscillator(omega, 0.3);  // a jump has none
  dry.friction = dry_friction(0.1);
  EXPECT_NEAR(decay(dry), 0.3 / 2, 1e-14);

  // Friction that changes from point to point makes a sponge of the linear part.
  Problem wave = klein_gordon({.grid = {.points = {8}}, .gamma = constant_rate(0.1)});
  wave.friction = formula_friction({.formula = compile_formula("0.4*v*x", {"v", "u", "t", "x", "y", "z"})}, wave.grid);
  Problem sponge = klein_gordon({.grid = {.points = {8}}, .gamma = constant_rate(0.1)});
  sponge.damping.field_rate = formula_space_rate(compile_formula("0.4*x", {"t", "x"}), 1, true)->on(sponge.grid);
  const Spectrum a = spectrum(wave, {.method = "seavf"}, h);
  const Spectrum b = spectrum(sponge, {.method = "seavf"}, h);
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i) EXPECT_NEAR(a.rows[i].exact_decay, b.rows[i].exact_decay, 1e-12);
}

TEST(Spectrum, OfTheDampedOscillatorIsTheClosedFormulaOfTheSplitting) {
  const double omega = 2.0, gamma = 0.3;
  const Problem p = damped_oscillator(omega, gamma);
  for (const double h : {1.0 / 64, 0.25, 1.0}) {
    const double cayley = 2 * std::atan(omega * h / 2);
    for (const auto& [method, angle] : std::vector<std::pair<std::string, double>>{{"seisav", omega * h},
                                                                                   {"seilm", omega * h},
                                                                                   {"seidm", omega * h},
                                                                                   {"seavf", omega * h},
                                                                                   {"ssav", cayley},
                                                                                   {"slm", cayley},
                                                                                   {"savf", cayley}}) {
      const Spectrum s = spectrum(p, {.method = method}, h);
      ASSERT_EQ(s.rows.size(), 1U) << method;
      EXPECT_TRUE(s.is_linear && s.is_homogeneous) << method;
      EXPECT_NEAR(s.rows[0].exact_decay, gamma / 2, 1e-14);
      EXPECT_NEAR(s.rows[0].exact_frequency, std::sqrt(omega * omega - gamma * gamma / 4), 1e-14);
      expect_factor(s.rows[0], factor_of_strang(angle, gamma, h), h, method);
    }
  }
}

TEST(Spectrum, OfCrankNicolsonHasTheFrequencyOfTheArcTangent) {
  const Problem p = klein_gordon({.grid = {.points = {16}, .length = {2.0}}, .gamma = RatePointer()});
  const double h = 1.0 / 8;
  for (const char* method : {"avf", "sav", "lm", "ssav"}) {
    const Spectrum s = spectrum(p, {.method = method}, h);
    ASSERT_EQ(s.rows.size(), 9U);
    for (const SpectrumRow& row : s.rows) {
      EXPECT_NEAR(row.numerical_frequency, 2 / h * std::atan(row.exact_frequency * h / 2), 1e-11) << method;
      EXPECT_NEAR(row.numerical_decay, 0, 1e-11) << method;
      EXPECT_FALSE(row.damping_differs()) << method;
    }
  }
}

// D merged into S: (I − hL/2)⁻¹(I + hL/2), and e^{hL}.
TEST(Spectrum, OfWholeMethodsIsThatOfTheirRationalFunctionOfL) {
  const Problem p = klein_gordon_case(0.5);
  const double h = 0.25;
  for (const SpectrumRow& row : spectrum(p, {.method = "avf"}, h).rows) {
    const Complex lambda(-row.exact_decay, row.exact_frequency);
    expect_factor(row, (2.0 + h * lambda) / (2.0 - h * lambda), h, "avf");
  }
  for (const char* method : {"eisav", "eilm", "eavf"})
    for (const SpectrumRow& row : spectrum(p, {.method = method}, h).rows)
      expect_factor(row, std::exp(h * Complex(-row.exact_decay, row.exact_frequency)), h, method);
}

TEST(Spectrum, OfCollocationIsExactOnEveryBackend) {
  int seen = 0;
  for (const auto& [name, problem] : all_cases()) {
    for (const BackendEntry& backend : backends_for(problem)) {
      if (problem.size() > 200) continue;
      const Spectrum s = spectrum(problem, {.method = "egc4", .backend = std::string(backend.name)}, 1.0 / 64);
      // γ(x), and friction that changes from point to point, is a force of collocation, and not part of its
      // exponential.
      const double tolerance = problem.damping.field_rate || problem.friction ? 1e-3 : 1e-9;
      for (const SpectrumRow& row : s.rows) {
        EXPECT_NEAR(row.damping_error(), 0, tolerance + row.round_off)
            << name << " " << backend.name << " " << row.mode;
        EXPECT_NEAR(row.numerical_frequency, row.exact_frequency, tolerance + row.round_off)
            << name << " " << backend.name << " " << row.mode;
      }
      ++seen;
    }
  }
  EXPECT_GT(seen, 30);
}

// Mode by mode of a grid, and by the eigenvectors of the matrices that the grid stands for: the same numbers.
TEST(Spectrum, OfAGridIsThatOfItsMatrices) {
  const Problem grid =
      chain({.points = 12, .ground_spring = 0.3, .neighbour_damping = 0.05, .gamma = constant_rate(0.2)});
  const Problem matrices = by_matrices(grid);
  for (const char* method : {"seisav", "ssav"}) {
    const Spectrum of_grid = spectrum(grid, {.method = method, .backend = "modal"}, 0.5);
    for (const char* backend : {"dense", "sparse"}) {
      const Spectrum of_matrices = spectrum(matrices, {.method = method, .backend = backend}, 0.5);
      ASSERT_EQ(of_matrices.rows.size(), of_grid.rows.size());
      for (std::size_t i = 0; i < of_grid.rows.size(); ++i) {  // both from slow to fast
        EXPECT_NEAR(of_matrices.rows[i].exact_decay, of_grid.rows[i].exact_decay, 1e-12);
        EXPECT_NEAR(of_matrices.rows[i].numerical_decay, of_grid.rows[i].numerical_decay, 1e-12) << backend;
        EXPECT_NEAR(of_matrices.rows[i].numerical_frequency, of_grid.rows[i].numerical_frequency, 1e-12) << backend;
      }
    }
  }
}

TEST(Spectrum, OfARateInSpaceFindsEachModeOfTheFullMatrix) {
  Problem p = klein_gordon({.grid = {.points = {32}, .length = {2.0}}});
  p.damping.rate = nullptr;
  p.damping.field_rate = formula_space_rate(compile_formula("2*exp(-8*(x-1)^2)", {"t", "x"}), 1, true)->on(p.grid);
  double before = 0;
  for (const double h : {1.0 / 16, 1.0 / 32, 1.0 / 64}) {
    const Spectrum s = spectrum(p, {.method = "seisav"}, h);
    double worst = 0;
    for (const SpectrumRow& row : s.rows) {
      worst = std::max(worst, std::hypot(row.damping_error(), row.numerical_frequency - row.exact_frequency));
      EXPECT_GE(row.exact_decay, 0);
    }
    if (before > 0) {
      EXPECT_NEAR(before / worst, 4.0, 0.5) << "the splitting is of order two, h = " << h;
    }
    before = worst;
  }
}

TEST(Spectrum, SaysWhatIsAliasedAndWhatIsNotLinear) {
  const Problem p = damped_oscillator(8.0, 0.1);
  const Spectrum coarse = spectrum(p, {.method = "eisav"}, 0.5);  // ωh = 4 > π
  EXPECT_TRUE(coarse.rows[0].aliased);
  EXPECT_NEAR(coarse.rows[0].numerical_frequency, coarse.rows[0].exact_frequency, 1e-11);
  EXPECT_THAT(spectrum_sentence(coarse), HasSubstr("modulo 2π/h"));
  EXPECT_FALSE(spectrum(p, {.method = "eisav"}, 0.25).rows[0].aliased);
  // No quadrature of the dissipation resolves a step of that length: the interval is as wide, and the projection does
  // not act.
  const Problem grid = chain({.points = 12, .neighbour_damping = 0.05, .gamma = constant_rate(0.2)});
  for (const Problem& rough : {grid, by_matrices(grid)}) {
    const Spectrum s = spectrum(rough, {.method = "egc2"}, 8.0);
    EXPECT_TRUE(s.is_linear);
    EXPECT_TRUE(s.is_homogeneous);
    for (const SpectrumRow& row : s.rows) EXPECT_NEAR(row.numerical_decay, row.exact_decay, 1e-12) << row.mode;
  }
}

TEST(Spectrum, TakesRatesAtTheStart) {
  Problem p = klein_gordon_case();
  p.damping.rate = formula_rate(compile_formula("0.4 + 0.3*sin(t)", {"t"}));
  const Spectrum s = spectrum(p, {.method = "seisav"}, 1.0 / 64);
  EXPECT_TRUE(s.rates_at_start);
  EXPECT_THAT(spectrum_table(s), HasSubstr("γ as it is at t = 0"));
  for (const SpectrumRow& row : s.rows) EXPECT_NEAR(row.numerical_decay, 0.2, 1e-10);
}

TEST(Spectrum, VerdictNamesTheModeThatIsDampedWrongly) {
  const Problem p = klein_gordon_case(0.5);
  const Spectrum s = spectrum(p, {.method = "avf"}, 0.25);
  const SpectrumVerdict verdict = judge(s);
  const double h = 0.25;
  double worst = 0;
  for (const SpectrumRow& row : s.rows) {
    const Complex lambda(-row.exact_decay, row.exact_frequency);
    const double decay = -std::log(std::abs((2.0 + h * lambda) / (2.0 - h * lambda))) / h;
    worst = std::max(worst, std::abs(decay - row.exact_decay) / row.exact_decay);
  }
  ASSERT_NE(verdict.worst_relative, nullptr);
  EXPECT_NEAR(verdict.relative, worst, 1e-9);
  EXPECT_THAT(spectrum_sentence(s), HasSubstr("Largest missing damping"));
  const Spectrum exact = spectrum(p, {.method = "eisav"}, h);
  EXPECT_THAT(spectrum_sentence(exact), HasSubstr("The damping is physical: every mode"));
}

TEST(Spectrum, RefusesWhatDoesNotApplyAndWhatIsTooLarge) {
  const auto complaint = [](const Problem& p, const char* method) -> std::string {
    return error_of([&] { spectrum(p, {.method = method}, 0.1); });
  };
  EXPECT_THAT(complaint(gkdv_case(), "avf"), HasSubstr("avf does not apply"));
  Problem p = klein_gordon({.grid = {.points = {2048}, .length = {2.0}}});
  p.damping.field_rate = formula_space_rate(compile_formula("x", {"t", "x"}), 1, true)->on(p.grid);
  EXPECT_THAT(complaint(p, "seisav"), HasSubstr("at most 2048 unknowns"));
}

TEST(Spectrum, JsonAndCsvHoldEveryMode) {
  const Spectrum s = spectrum(klein_gordon_case(0.5), {.method = "avf"}, 0.25);
  const nlohmann::json document = nlohmann::json::parse(spectrum_json(s));
  ASSERT_EQ(document["modes"].size(), s.rows.size());
  EXPECT_EQ(document["modes"][3]["numerical_decay"].get<double>(), s.rows[3].numerical_decay);
  EXPECT_FALSE(document["verdict"]["physical_to_round_off"].get<bool>());
  const std::string csv = spectrum_csv(s);
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), s.rows.size() + 1);
}

TEST(EigenPairs, TellHowFarRoundOffMovesThem) {
  Eigen::MatrixXcd A(2, 2);
  A << 1, 0.5, 0, 1;  // a Jordan block
  const Eigen::MatrixXd noise = Eigen::MatrixXd::Constant(2, 2, 1e-14);
  const EigenPairs exact = eigenpairs(A, noise);
  A(1, 0) = 1e-14;
  const EigenPairs moved = eigenpairs(A, noise);
  const double shift = std::abs(moved.values[0] - 1.0);
  EXPECT_GT(shift, 5e-8);
  EXPECT_GE(exact.uncertainty.maxCoeff(), shift);
  EXPECT_LE(exact.uncertainty.maxCoeff(), 4 * shift);
  A << 1, 0, 0, 2;
  EXPECT_LE(eigenpairs(A, noise).uncertainty.maxCoeff(), 2e-14);
}

TEST(EigenPairs, AreMatchedByTheirVectorsAndTheirValues) {
  Eigen::MatrixXcd A(2, 2), B(2, 2);
  A << 0, 1, -1, 0;
  B << 0, 2, -2, 0;
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(2, 2);
  const EigenPairs a = eigenpairs(A, none), b = eigenpairs(B, none);
  const std::vector<Index> partner = partners(a, b, a.values);
  for (Index i = 0; i < 2; ++i)
    EXPECT_NEAR(std::abs(b.values[partner[static_cast<std::size_t>(i)]] - 2.0 * a.values[i]), 0, 1e-15);
}

// With γ this large the slow modes have two rates each and the fast ones a frequency.
TEST(Spectrum, AShortTableLeavesOutWholeModesAndNoRowOfThoseItShows) {
  const Problem problem = klein_gordon({.grid = {.points = {200}, .length = {2.0}}, .gamma = constant_rate(30)});
  const Spectrum s = spectrum(problem, {.method = "seisav"}, 1.0 / 256);
  std::map<std::string, int> rates, shown;
  for (const SpectrumRow& row : s.rows) ++rates[row.mode];
  ASSERT_GT(s.rows.size(), rates.size()) << "no mode has two rates";
  std::istringstream table(spectrum_table(s));
  for (std::string line, mode; std::getline(table, line);)
    if (std::istringstream(line) >> mode && rates.contains(mode)) ++shown[mode];
  EXPECT_GT(shown.size(), 10U);
  EXPECT_LT(shown.size(), rates.size());
  for (const auto& [mode, rows] : shown) EXPECT_EQ(rows, rates[mode]) << "mode " << mode;
  EXPECT_THAT(spectrum_table(s), HasSubstr(fmt::format("one of {} modes in each", rates.size())));
}

TEST(Spectrum, WhereNothingIsLinearASentenceStandsForATableOfZeros) {
  const auto table = [](double gamma) {
    return spectrum_table(spectrum(damped_oscillator(0.0, gamma), {.method = "seisav"}, 1.0 / 64));
  };
  EXPECT_THAT(table(0.0), testing::AllOf(HasSubstr("all its rates are zero"), testing::Not(HasSubstr("phase error"))));
  EXPECT_THAT(table(0.1), testing::AllOf(HasSubstr("phase error"), testing::Not(HasSubstr("all its rates"))));
}

TEST(Spectrum, StopsWhenAsked) {
  const std::atomic<bool> stop = true;
  EXPECT_EQ(error_of([&] { spectrum(damped_oscillator(1.0, 0.1), {.method = "seisav"}, 0.1, &stop); }), "interrupted");
}

}  // namespace TEST_FILE
}  // namespace seiche::test
