// Slow motion beside fast motion: the energy law holds however large hω, and what moves slowly keeps its digits.
#include <test/support/cases.hpp>

#include <seiche/damping/rates.hpp>
#include <seiche/method/methods.hpp>
#include <seiche/problem/sparse.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <random>

namespace seiche::test {
namespace TEST_FILE {

using Matrix = Eigen::MatrixXd;

constexpr double start_p = 0.3;  // q(0) = 1/ω

// q'' + γq' + ω²q = 0 from (1/ω, 0.3): (ωq, p) in extended precision.
std::pair<double, double> oscillator(double omega, double gamma, double t) {
  using Complex = std::complex<long double>;
  const long double w = omega;
  const Complex root = std::sqrt(Complex(static_cast<long double>(gamma) * gamma / 4 - w * w));
  const Complex a = -static_cast<long double>(gamma) / 2 + root;
  const Complex b = -static_cast<long double>(gamma) / 2 - root;
  const Complex of_a = (static_cast<long double>(start_p) - b / w) / (a - b);
  const Complex of_b = 1 / w - of_a;
  const Complex ea = std::exp(a * static_cast<long double>(t));
  const Complex eb = std::exp(b * static_cast<long double>(t));
  return {static_cast<double>((w * (of_a * ea + of_b * eb)).real()),
          static_cast<double>((a * of_a * ea + b * of_b * eb).real())};
}

SparseMatrix sparse(const Matrix& a) { return a.sparseView(); }

// One oscillator for each rate.
Problem decoupled(const std::vector<double>& rates, double gamma) {
  const auto n = static_cast<Index>(rates.size());
  Matrix M = Matrix::Identity(2 * n, 2 * n);
  for (Index i = 0; i < n; ++i) M(i, i) = square(rates[static_cast<std::size_t>(i)]);
  Problem p = sparse_problem(
      {.matrices = {.S = {}, .M = sparse(M), .D = {}}, .gamma = gamma > 0 ? constant_rate(gamma) : nullptr});
  for (Index i = 0; i < n; ++i) {
    p.initial[i] = 1 / rates[static_cast<std::size_t>(i)];
    p.initial[n + i] = start_p;
  }
  return p;
}

Matrix random_orthogonal(Index n) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const Matrix a = Matrix::NullaryExpr(n, n, [&] { return normal(random); });
  return Eigen::HouseholderQR<Matrix>(a).householderQ() * Matrix::Identity(n, n);
}

struct Outcome {
  Vector z;               // physical, at the end
  double worst_rise = 0;  // of the energy that is kept, in units of its round-off
};

Outcome run(const MethodEntry& method, const Problem& problem, std::string_view backend, double h, int steps) {
  const Problem of_method = method.kind.merges_damping ? with_damping_merged(problem) : problem;
  const System system = find_backend(backend).system(of_method, {});
  MethodOptions options;
  if (method.projects() && problem.has_damping())
    options.law = EnergyLaw::guard;  // quadrature does not resolve the dissipation
  const auto stepper = make_stepper(method, system, options);
  State s;
  s.z = system.initial;
  stepper->begin(s);
  Outcome result;
  EnergyReading before = stepper->energy(s);
  for (int i = 0; i < steps; ++i) {
    const StepReport report = stepper->step(s, h);
    EXPECT_TRUE(report.solved()) << report.message;
    if (!report.solved()) break;
    s.t += h;
    ++s.n;
    const EnergyReading now = stepper->energy(s);
    const double round_off = std::max(now.modified_round_off, before.modified_round_off);
    result.worst_rise = std::max(result.worst_rise, (now.modified - before.modified) / round_off);
    before = now;
  }
  result.z = system.space->physical(s.z);
  return result;
}

bool is_exact_for_linear_equations(const MethodEntry& method, bool damped) {
  if (method.propagator == PropagatorKind::cayley && !method.projects()) return false;
  if (method.kind.composition == "chin") return false;
  return !damped || method.projects() || method.kind.merges_damping;
}

TEST(StiffRates, DecoupledSlowMotionKeepsItsDigitsBesideAnyRateByEveryMethod) {
  const std::vector<double> rates = {1e9, 1, 1e3, 30, 1e5, 1e7};
  constexpr Index slow = 1;
  int exact = 0;
  for (const double gamma : {0.0, 0.125}) {
    const Problem problem = decoupled(rates, gamma);
    const auto [q, p] = oscillator(1, gamma, 10);
    for (const MethodEntry& method : methods()) {
      if (!applies(method.name, problem)) continue;
      SCOPED_TRACE(fmt::format("{} γ = {}", method.name, gamma));
      const Outcome r = run(method, problem, "dense", 0.125, 80);
      EXPECT_LE(r.worst_rise, 1);
      if (!is_exact_for_linear_equations(method, gamma > 0)) continue;
      EXPECT_NEAR(r.z[slow], q, 1e-13);
      EXPECT_NEAR(r.z[6 + slow], p, 1e-13);
      ++exact;
    }
  }
  EXPECT_GE(exact, 20);
}

// Two waves on one grid, the second ten million times as fast, and both with a mean that nothing holds.
Problem two_waves(double gamma) {
  Problem p;
  p.name = "two waves";
  p.grid = Grid{.axes = {GridAxis{.intervals = 8, .length = 2.0}}};
  p.fields = {"u", "w", "u_t", "w_t"};
  p.S = p.M = BlockStencil(4);
  p.damping.constant = BlockStencil(4);
  for (Index f = 0; f < 2; ++f) {
    p.S(f, f + 2) = Stencil::identity();
    p.S(f + 2, f) = Stencil::identity(-1);
    p.M(f + 2, f + 2) = Stencil::identity();
    p.M(f, f) = (f == 0 ? -1.0 : -1e14) * Stencil::laplacian(p.grid);
  }
  if (gamma > 0) {
    p.damping.rate = constant_rate(gamma);
    p.damping.rate_fields = {false, false, true, true};
  }
  const double omega = 8 * std::sin(std::numbers::pi / 8);  // 2/Δx sin(π/N)
  p.initial.resize(32);
  for (Index i = 0; i < 8; ++i) {
    const double wave = std::cos(2 * std::numbers::pi * static_cast<double>(i) / 8);
    p.initial[i] = wave / omega;
    p.initial[8 + i] = 1e-7 * static_cast<double>(i);
    p.initial[16 + i] = start_p * wave;
    p.initial[24 + i] = 0.2;
  }
  return p;
}

TEST(StiffRates, FieldsOfOneModeKeepTheirDigits) {
  for (const double gamma : {0.0, 0.125}) {
    const Problem problem = two_waves(gamma);
    const double omega = 8 * std::sin(std::numbers::pi / 8);
    const auto [omega_q, p] = oscillator(omega, gamma, 10);
    for (const std::string_view backend : {"dense", "modal"}) {
      for (const char* name :
           {"eisav", "eavf", "egc2", "egc4", "egc6", "egc8", "etdrk4", "crkn4", "crkn6", "strang_exact"}) {
        const MethodEntry& method = find_method(name);
        if (!is_exact_for_linear_equations(method, gamma > 0)) continue;
        SCOPED_TRACE(fmt::format("{} {} γ = {}", name, backend, gamma));
        const Outcome r = run(method, problem, backend, 0.125, 80);
        EXPECT_LE(r.worst_rise, 1);
        for (Index i = 0; i < 8; ++i) {
          const double wave = std::cos(2 * std::numbers::pi * static_cast<double>(i) / 8);
          EXPECT_NEAR(r.z[i], omega_q / omega * wave, 1e-13);
          EXPECT_NEAR(r.z[16 + i], p * wave, 1e-13);
        }
      }
    }
  }
}

// Mixed by an orthogonal change of variables, a rate ω of one motion is rounded by ε times the fastest one, and so is
// every other: what moves slowly cannot be known better than to ε ω_max t, but for a small factor.
TEST(StiffRates, MixedMotionLosesWhatTheRoundingOfItsMatricesLoses) {
  constexpr Index n = 5;
  const Matrix Q = random_orthogonal(2 * n);
  for (const double fastest : {1e3, 1e5, 1e7, 1e9}) {
    const std::vector<double> rates = {1, fastest, 30, std::sqrt(fastest), 3};
    Matrix S = Matrix::Zero(2 * n, 2 * n);
    for (Index i = 0; i < n; ++i) {
      S(i, n + i) = rates[static_cast<std::size_t>(i)];
      S(n + i, i) = -S(i, n + i);
    }
    const Matrix QSQ = Q * S * Q.transpose();
    Problem problem = sparse_problem(
        {.fields = 1, .matrices = {.S = sparse((QSQ - QSQ.transpose()) / 2), .M = identity_matrix(2 * n), .D = {}}});
    Vector start = Vector::Constant(2 * n, 1.0);
    start.tail(n).setConstant(start_p);
    problem.initial = Q * start;
    const auto [q, p] = oscillator(1, 0, 10);
    const double bound = 20 * epsilon * fastest * 10;
    for (const MethodEntry& method : methods()) {
      if (!applies(method.name, problem)) continue;
      SCOPED_TRACE(fmt::format("{} ω = {}", method.name, fastest));
      const Outcome r = run(method, problem, "dense", 0.125, 80);
      EXPECT_LE(r.worst_rise, 1);
      if (!is_exact_for_linear_equations(method, false)) continue;
      const Vector z = Q.transpose() * r.z;
      EXPECT_NEAR(z[0], q, bound);
      EXPECT_NEAR(z[n], p, bound);
    }
  }
}

// Where M is what is mixed, squares of rates are rounded: δω = εω_max²/2ω. The law holds even where nothing of the slow
// motion is left.
TEST(StiffRates, MixedStiffnessIsRoundedByTheSquareOfTheFastestRate) {
  constexpr Index n = 5;
  const Matrix Q = random_orthogonal(n);
  for (const double gamma : {0.0, 0.125}) {
    const auto [q, p] = oscillator(1, gamma, 10);
    for (const double fastest : {1e3, 1e5, 1e7, 1e9}) {
      const Vector squares = Vector{{1, square(fastest), 900, fastest, 9}};
      Matrix M = Matrix::Identity(2 * n, 2 * n);
      const Matrix K = Q * squares.asDiagonal() * Q.transpose();
      M.topLeftCorner(n, n) = (K + K.transpose()) / 2;
      Problem problem = decoupled({1, 1, 1, 1, 1}, gamma);
      const SparseOperators& operators = *problem.matrices;
      problem.matrices =
          std::make_shared<SparseOperators>(SparseOperators{.S = operators.S, .M = sparse(M), .D = operators.D});
      problem.initial << Q * squares.cwiseSqrt().cwiseInverse(), Q * Vector::Constant(n, start_p);
      const double bound = 20 * epsilon * square(fastest) * 10 / 2;
      for (const MethodEntry& method : methods()) {
        if (!applies(method.name, problem)) continue;
        SCOPED_TRACE(fmt::format("{} ω = {} γ = {}", method.name, fastest, gamma));
        const Outcome r = run(method, problem, "dense", 0.125, 80);
        EXPECT_LE(r.worst_rise, 1);
        // Beyond, round-off in M may turn the slow motion into a free one.
        if (!is_exact_for_linear_equations(method, gamma > 0) || bound > 0.1) continue;
        EXPECT_NEAR(Q.col(0).dot(r.z.head(n)), q, bound);
        EXPECT_NEAR(Q.col(0).dot(r.z.tail(n)), p, bound);
      }
    }
  }
}

// S is not skew, and what it takes to zero (cᵀS = 0, S(1, −1, 2)ᵀ = 0) is not the same on its two sides: c stays, and a
// and b turn about ±½.
TEST(StiffRates, InvariantsStayWhereSFeedsEnergy) {
  Problem problem = sparse_problem({.fields = 1,
                                    .matrices = {.S = sparse(Matrix{{0, 1000, 500}, {-1000, 0, 500}, {0, 0, 0}}),
                                                 .M = identity_matrix(3),
                                                 .D = {}}});
  problem.initial = Vector{{1, 0, 1}};
  const double c = std::cos(1000.0) / 2, s = std::sin(1000.0) / 2;
  const Vector exact{{0.5 + c + s, -0.5 + c - s, 1}};
  for (const MethodEntry& method : methods()) {
    if (!applies(method.name, problem) || !is_exact_for_linear_equations(method, false)) continue;
    for (const std::string_view backend : {"dense", "sparse"}) {
      for (const double h : {1.0 / 16, 1.0 / 4, 1.0}) {  // hρ = 62 … 1000
        SCOPED_TRACE(fmt::format("{} {} h = {}", method.name, backend, h));
        const Outcome r = run(method, problem, backend, h, static_cast<int>(1 / h));
        EXPECT_LE((r.z - exact).lpNorm<Eigen::Infinity>(), 1e-10);
      }
    }
  }
}

TEST(StiffRates, DampingThatFeedsIsNotRefused) {
  Matrix D = Matrix::Zero(2, 2), M = Matrix::Identity(2, 2);
  D(1, 1) = -0.1;
  M(0, 0) = 1e6;
  Problem problem = sparse_problem({.matrices = {.S = {}, .M = sparse(M), .D = sparse(D)}});
  problem.initial = Vector{{1e-3, start_p}};
  const auto [q, p] = oscillator(1e3, -0.1, 10);
  for (const char* name : {"eavf", "eisav", "egc4", "etdrk4"}) {
    SCOPED_TRACE(name);
    const Outcome r = run(find_method(name), problem, "dense", 0.125, 80);
    EXPECT_NEAR(1e3 * r.z[0], q, 1e-10);
    EXPECT_NEAR(r.z[1], p, 1e-10);
  }
}

// ½zᵀMz + fᵀz does not rise in z ← z + F(Mz + f), beyond the round-off of its terms: the contract, as every closure
// meets it.
double worst_rise(const System& system, const Propagator& propagator, double fastest) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const Index size = system.space->size();
  double worst = 0;
  for (int sample = 0; sample < 20; ++sample) {
    Vector z = Vector::NullaryExpr(size, [&] { return normal(random); });
    if (sample % 2 == 0) z.head(size / 2) /= fastest;
    Vector f = Vector::NullaryExpr(size, [&] { return normal(random); });
    if (sample % 3 == 0) f.setZero();
    Vector dz = z;
    Vector q = z;
    propagator.increment(z, dz);
    propagator.force(f, q);
    const Vector after = z + dz + q;
    const auto energy = [&](const Vector& x) { return system.linear->quadratic_energy(x) + f.dot(x); };
    const auto size_of = [&](const Vector& x) {
      return 2 * system.linear->quadratic_magnitude(x) + f.cwiseAbs().dot(x.cwiseAbs());
    };
    const Vector parts = dz.cwiseAbs() + q.cwiseAbs() + z.cwiseAbs();
    worst = std::max(worst, (energy(after) - energy(z)) / (50 * epsilon * (size_of(parts) + size_of(z))));
  }
  return worst;
}

Problem short_wave(double length, const RatePointer& gamma) {
  Problem p = klein_gordon_case(0.0, 0.0);
  p.grid = Grid{.axes = {GridAxis{.intervals = 8, .length = length}}};
  p.M(0, 0) = -1.0 * Stencil::laplacian(p.grid);
  p.damping.rate = gamma;
  p.damping.rate_fields = {false, true};
  p.potential = nullptr;
  p.initial = Vector::LinSpaced(16, 0, 1);
  return p;
}

TEST(StiffRates, TheContractHoldsWhateverTheStep) {
  for (const double length : {1.0, 1e-3, 1e-6, 1e-9, 1e-12}) {
    for (const double gamma : {0.0, 1e-9, 0.1, 1e4}) {
      const Problem wave = short_wave(length, gamma > 0 ? constant_rate(gamma) : nullptr);
      const Problem problem = gamma > 0 ? with_damping_merged(wave) : wave;
      for (const std::string_view backend : {"dense", "modal"}) {
        const System system = find_backend(backend).system(problem, {});
        for (const PropagatorKind kind : {PropagatorKind::exponential, PropagatorKind::cayley}) {
          for (const double h : {0.125, 10.0}) {
            SCOPED_TRACE(fmt::format("length {} γ = {} {} {} h = {}", length, gamma, backend,
                                     kind == PropagatorKind::cayley ? "cayley" : "exponential", h));
            EXPECT_LE(worst_rise(system, *system.linear->propagator(kind, h), 16 / length), 1);
          }
        }
      }
    }
  }
}

// Damping on one point of eight, merged into S: round-off must not feed what is hardly damped.
TEST(StiffRates, TheContractHoldsWhereLittleIsDamped) {
  constexpr Index n = 8;
  for (const double length : {1e-2, 1e-5, 1e-8}) {
    for (const double gamma : {1e-12, 1e-3, 1e3}) {
      Matrix M = Matrix::Identity(2 * n, 2 * n);
      M.topLeftCorner(n, n) = -Stencil::laplacian(Grid{.axes = {GridAxis{.intervals = n, .length = length}}})
                                   .matrix(Grid{.axes = {GridAxis{.intervals = n, .length = length}}});
      Matrix D = Matrix::Zero(2 * n, 2 * n);
      D(n, n) = gamma;
      const Problem problem =
          with_damping_merged(sparse_problem({.matrices = {.S = {}, .M = sparse(M), .D = sparse(D)}}));
      const System system = find_backend("dense").system(problem, {});
      for (const PropagatorKind kind : {PropagatorKind::exponential, PropagatorKind::cayley}) {
        SCOPED_TRACE(fmt::format("length {} γ = {} {}", length, gamma, kind == PropagatorKind::cayley));
        EXPECT_LE(worst_rise(system, *system.linear->propagator(kind, 0.125), 2 * n / length), 1);
      }
    }
  }
}

// gKdV on a short interval: S and M are singular, and Σz and Σ(−1)ʲz are Casimirs.
TEST(StiffRates, CasimirsStayWhateverTheStep) {
  for (const double length : {10.0, 0.1, 1e-3}) {
    Problem p = gkdv_case(0.0, 0.001);
    p.grid.axes[0].length = length;
    p.S(0, 0) = Stencil::derivative(p.grid);
    p.M(0, 0) = -1.0 * Stencil::laplacian(p.grid);
    const System system = find_backend("dense").system(p, {});
    const double dx = p.grid.axis(0).dx();
    for (const PropagatorKind kind : {PropagatorKind::exponential, PropagatorKind::cayley}) {
      const auto propagator = system.linear->propagator(kind, 0.125);
      Vector z = system.initial;
      Vector dz = z;
      for (int i = 0; i < 100; ++i) {
        propagator->increment(z, dz);
        z += dz;
      }
      double alternating = 0;
      for (Index j = 0; j < z.size(); ++j) alternating += (j % 2 == 0 ? 1 : -1) * (z[j] - system.initial[j]);
      EXPECT_NEAR(z.sum(), system.initial.sum(), 1e-12) << "Δx = " << dx;
      EXPECT_NEAR(alternating, 0, 1e-12) << "Δx = " << dx;
      EXPECT_LE(worst_rise(system, *propagator, 1), 1) << "Δx = " << dx;
    }
    for (const char* name : {"egc4", "etdrk4"}) {
      Problem damped = p;
      damped.damping.rate = constant_rate(0.5);
      damped.damping.rate_fields = {true};
      damped.potential = nullptr;
      const Outcome r = run(find_method(name), damped, "dense", 0.125, 80);
      EXPECT_NEAR(r.z.sum(), std::exp(-5.0) * p.initial.sum(), 1e-13 * p.initial.sum()) << name << " Δx = " << dx;
    }
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
