// Sparse matrices: the backend, and the problems that need it.
#include <test/support/error_of.hpp>
#include <test/support/matrices.hpp>
#include <test/support/worst.hpp>

#include <seiche/backend/backends.hpp>
#include <seiche/backend/sparse/pade_poles.hpp>
#include <seiche/backend/sparse/resolvent.hpp>
#include <seiche/core/control/stop_request.hpp>
#include <seiche/core/numerics/definiteness.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/law/law.hpp>
#include <seiche/problem/network.hpp>
#include <seiche/problem/sparse.hpp>
#include <seiche/problem/truss.hpp>
#include <seiche/problem/variable_wave.hpp>
#include <seiche/simulation/simulation.hpp>

#include <gtest/gtest.h>
#include <Eigen/SparseLU>

#include <atomic>
#include <cmath>

namespace seiche::test {
namespace TEST_FILE {

System sparse(const Problem& problem, const SparseOptions& options = {}) {
  return find_backend("sparse").system(problem, {.sparse = options});
}

// Layers with c = 1 and 2, without damping; α u³ with α = 1.
Problem layered_wave(Index points = 12, RatePointer gamma = nullptr) {
  return variable_wave({.grid = {.points = {points}, .length = {2.0}, .boundary = {Boundary::dirichlet}},
                        .speed = [](const auto& x) { return x[0] > 1.0 ? 2.0 : 1.0; },
                        .mass = 0.5,
                        .alpha = 1.0,
                        .gamma = std::move(gamma)});
}

Matrix force_of(const System& system, const Propagator& propagator) {
  return matrix_of(system, [&](const Vector& x, Vector& y) { propagator.force(x, y); });
}

double contract_defect(const Matrix& F, const Matrix& M) {
  const Matrix FMF = F.transpose() * M * F;
  return largest(F + F.transpose() + FMF) / (largest(F) + largest(FMF));
}

double distance(const Vector& a, const Vector& b) { return largest(a - b); }

TEST(Sparse, PadePartsEndWhereARunIsAskedToStop) {
  const Problem p = layered_wave();
  const System system = sparse(p);
  const auto propagator = system.linear->propagator(PropagatorKind::exponential, 1e9);
  const std::atomic<bool> stop = true;
  const StopRequest request(&stop);
  Vector q(p.size());
  EXPECT_THROW(propagator->force(Vector::Ones(p.size()), q), Stopped);
}

TEST(Sparse, PadeOfEveryDegreeKeepsTheContractAtStepsWhereItIsNotAccurate) {
  const Problem p = layered_wave();
  const Matrix M = Matrix(p.matrices->M);
  for (int q = 1; q <= max_pade_degree; ++q) {
    const System system = sparse(p, {.pade_degree = q});
    for (const double h : {0.01, 0.1, 1.0, 10.0}) {
      const auto propagator = system.linear->propagator(PropagatorKind::exponential, h);
      EXPECT_LE(contract_defect(force_of(system, *propagator), M), 1e-13) << "q = " << q << " h = " << h;
    }
  }
}

TEST(Sparse, PadeOfDegreeQHasTheErrorOfItsDegree) {
  // |r(ix) − e^{ix}| = (q!)²/((2q)!(2q+1)!) x^{2q+1} (1 + O(x²)), on the axis where the spectrum is.
  for (int q = 1; q <= 6; ++q) {
    const std::complex<double> x(0, 0.5);
    std::complex<double> r = 1;
    for (const std::complex<double>& p : pade_poles(q)) {
      r *= -(x + p) / (x - p);
      if (p.imag() != 0) r *= -(x + std::conj(p)) / (x - std::conj(p));
    }
    const double expected = std::exp(2 * std::lgamma(q + 1.0) - std::lgamma(2 * q + 1.0) - std::lgamma(2 * q + 2.0)) *
                            std::pow(0.5, 2 * q + 1);
    EXPECT_NEAR(std::abs(r - std::exp(x)), expected, 0.1 * expected + 4e-16) << q;
  }
}

TEST(Sparse, TheAutomaticDegreeGivesTheExponentialAtAnyStep) {
  for (const Problem& p : {layered_wave(), truss({.panels = 3, .mass = 2.0, .dashpot = 0.0})}) {
    const Matrix A = Matrix(p.matrices->S) * Matrix(p.matrices->M);
    const System system = sparse(p);
    for (const double h : {1.0 / 64, 0.3, 3.0}) {
      const auto propagator = system.linear->propagator(PropagatorKind::exponential, h);
      const Matrix E = Matrix::Identity(A.rows(), A.cols()) +
                       matrix_of(system, [&](const Vector& x, Vector& y) { propagator->increment(x, y); });
      const Matrix expected = exponential_by_extended_series(A * h);
      EXPECT_LE(largest(E - expected), 1e-12 * largest(expected)) << p.name << h;
    }
  }
}

TEST(Sparse, LanczosKeepsTheContractOnTheSpanOfItsTwoVectorsAtEveryDimension) {
  const Problem p = layered_wave(60);
  for (const int m : {2, 3, 4, 8, 16}) {
    const System system = sparse(p, {.exponential = ExponentialKind::lanczos, .lanczos_dimension = m});
    for (const double h : {0.05, 1.0}) {
      const auto propagator = system.linear->propagator(PropagatorKind::exponential, h);
      const Vector z = Vector::Random(p.size());
      Vector f = Vector::Zero(p.size());
      f.head(p.size() / 2) = Vector::Random(p.size() / 2);
      const double energy = z.dot(p.matrices->M * z) / 2;
      for (const double factor : {0.0, 1.0, -3.0}) {
        Vector z_plus = z;
        const Propagator::Powers powers = propagator->powers(z, f);
        propagator->update(z_plus, f, factor);
        EXPECT_NEAR(powers.quadratic_energy, energy, 1e-13 * energy);
        // ½z⁺ᵀMz⁺ − ½zᵀMz + factor fᵀ(z⁺ − z) = 0, and fᵀ(z⁺ − z) is what was told before
        const double work = factor * f.dot(z_plus - z);
        const double after = z_plus.dot(p.matrices->M * z_plus) / 2;
        const double size = energy + after + std::abs(work);
        EXPECT_NEAR(after - energy + work, 0, 1e-13 * size) << m << " " << h << " " << factor;
        EXPECT_NEAR(work, factor * (powers.of_increment + factor * powers.of_force), 1e-13 * size);
      }
    }
  }
}

TEST(Sparse, LanczosThatSettlesIsTheExponentialForEveryVerb) {
  const Problem p = layered_wave(40);
  const System pade = sparse(p);
  const System lanczos = sparse(p, {.exponential = ExponentialKind::lanczos});
  const double h = 0.2;
  const auto a = pade.linear->propagator(PropagatorKind::exponential, h);
  const auto b = lanczos.linear->propagator(PropagatorKind::exponential, h);
  const Vector z = Vector::Random(p.size());
  Vector f = Vector::Zero(p.size());
  f.head(p.size() / 2) = Vector::Random(p.size() / 2);
  Vector x = Vector::Zero(p.size());
  Vector y = Vector::Zero(p.size());
  a->increment(z, x);
  b->increment(z, y);
  const double scale = 1e-11 * largest(x);
  EXPECT_LE(distance(x, y), scale);
  a->force(f, x);
  b->force(f, y);
  EXPECT_LE(distance(x, y), scale);
  x.setZero();
  y.setZero();
  a->predict(z, f, x);
  b->predict(z, f, y);
  EXPECT_LE(distance(x, y), scale);
  x = y = z;
  for (const auto& [propagator, result] : {std::pair(a.get(), &x), std::pair(b.get(), &y)}) {
    propagator->powers(z, f);
    propagator->update(*result, f, 2.0);
  }
  EXPECT_LE(distance(x, y), scale);
}

TEST(SparseSlow, TheEnergyLawHoldsToTwelveDigitsHoweverCoarseTheExponential) {
  const Problem p = layered_wave(200);
  for (const SparseOptions& options :
       {SparseOptions{.pade_degree = 2},
        SparseOptions{.exponential = ExponentialKind::lanczos, .lanczos_dimension = 8}}) {
    Simulation simulation(p, {.method = "seisav", .backend = "sparse", .backend_options = {.sparse = options}});
    const double start = simulation.energy().modified;
    double drift = 0;
    for (int n = 0; n < 50; ++n) {
      ASSERT_TRUE(simulation.step(0.05).solved());
      drift = worse(drift, std::abs(simulation.energy().modified - start));
    }
    EXPECT_LE(drift, 1e-12 * (start + simulation.state().shift));
    Simulation exact(p, {.method = "seisav", .backend = "dense"});
    for (int n = 0; n < 50; ++n) exact.step(0.05);
    EXPECT_GT(distance(exact.physical(), simulation.physical()), 1e-6);  // or the exponential was not coarse
  }
}

TEST(Sparse, LanczosSaysWhereItDoesNotApply) {
  const SparseOptions lanczos{.exponential = ExponentialKind::lanczos};
  Problem periodic = variable_wave({.grid = {.points = {8}}});  // M annihilates constants
  EXPECT_NE(error_of([&] { sparse(periodic, lanczos); }).find("M positive definite"), std::string::npos);
  const Problem merged = with_damping_merged(layered_wave(12, constant_rate(0.1)));
  EXPECT_NE(error_of([&] { sparse(merged, lanczos); }).find("skew"), std::string::npos);
  EXPECT_NE(error_of([&] { sparse(merged, {.pade_degree = 13}); }).find("between 1 and 12"), std::string::npos);
}

// So many blocks as the spectrum is long, and no step takes more than a few hundred.
TEST(SparseSlow, LanczosThatDoesNotSettleSaysWhatWouldHelp) {
  const Problem p = layered_wave(1500);
  const System pade = sparse(p);
  const System lanczos = sparse(p, {.exponential = ExponentialKind::lanczos});
  const Vector z = Vector::Random(p.size());
  Vector x = Vector::Zero(p.size());
  Vector y = Vector::Zero(p.size());
  pade.linear->propagator(PropagatorKind::exponential, 0.05)->increment(z, x);
  lanczos.linear->propagator(PropagatorKind::exponential, 0.05)->increment(z, y);  // hρ = 150
  EXPECT_LE(distance(x, y), 1e-11 * largest(x));
  const auto too_long = lanczos.linear->propagator(PropagatorKind::exponential, 0.3);  // hρ = 900
  const std::string message = error_of([&] { too_long->increment(z, y); });
  for (const char* part : {"400", "hρ", "h = 0.3", "smaller h", "pade"})
    EXPECT_NE(message.find(part), std::string::npos) << part << ": " << message;
}

TEST(Sparse, TheDampingFlowIsTheExponentialOfDAndShrinksTheMetric) {
  const Problem p = truss({.panels = 4, .dashpot = 3.0});
  const System system = sparse(p);
  const Matrix D = Matrix(p.matrices->D);
  const Matrix M = Matrix(p.matrices->M);
  for (const double h : {0.01, 0.5, 20.0}) {
    const Matrix flow = matrix_of(system, [&](const Vector& x, Vector& y) {
      y = x;
      system.damping->flow(0.0, h, y);
    });
    EXPECT_LE(largest(flow - exponential_by_extended_series(-h * D)), 1e-13) << h;
    const Matrix defect = flow.transpose() * M * flow - M;
    EXPECT_LE(Eigen::SelfAdjointEigenSolver<Matrix>(defect).eigenvalues().maxCoeff(), 1e-12 * largest(M));
  }
}

TEST(Sparse, APulseIsReflectedAndTransmittedBetweenLayersAsFresnelSays) {
  // u and the flux c²u_x are continuous: (c₁ − c₂)/(c₁ + c₂) of a pulse comes back and 2c₁/(c₁ + c₂) goes on.
  Problem p = variable_wave({.grid = {.points = {2000}, .length = {8.0}, .boundary = {Boundary::dirichlet}},
                             .speed = [](const auto& x) { return x[0] > 4.0 ? 2.0 : 1.0; }});
  const Index n = p.grid.unknowns();
  for (Index i = 0; i < n; ++i) {
    const double x = p.grid.coordinate(i, 0) - 2.5;
    p.initial[i] = std::exp(-40 * x * x);
    p.initial[n + i] = 80 * x * p.initial[i];  // to the right
  }
  Simulation simulation(p, {.method = "seisav", .backend = "sparse"});
  for (int k = 0; k < 50; ++k) ASSERT_TRUE(simulation.step(0.05).solved());
  const Vector u = simulation.physical().head(n);
  EXPECT_NEAR(u.head(n / 2).minCoeff(), -1.0 / 3, 2e-3);
  EXPECT_NEAR(u.tail(n / 2).maxCoeff(), 2.0 / 3, 2e-3);
}

TEST(Sparse, EveryProblemOfMatricesKeepsItsPromises) {
  for (const Problem& p : {layered_wave(12, constant_rate(0.1)), truss({.gamma = constant_rate(0.05)}), network({}),
                           sparse_problem({.matrices = {.M = layered_wave().matrices->M}})}) {
    EXPECT_NO_THROW(p.matrices->validate()) << p.name;
    const LawPromise promise = promise_energy_law(p, 10);
    EXPECT_TRUE(promise.promised) << p.name << ": " << promise.reason;
  }
  EXPECT_FALSE(promise_energy_law(layered_wave(12, constant_rate(-0.1)), 10).promised);
  Problem fed = truss({.panels = 3});
  auto matrices = std::make_shared<SparseOperators>(*fed.matrices);
  matrices->D = -1.0 * matrices->D;
  fed.matrices = matrices;
  EXPECT_NE(promise_energy_law(fed, 10).reason.find("feeds"), std::string::npos);
}

TEST(Sparse, MatricesThatBreakAHypothesisAreRefusedWithAWitness) {
  const SparseMatrix good = layered_wave().matrices->M;
  const auto refused = [](SparseOperators m) { return error_of([&] { sparse_problem({.matrices = std::move(m)}); }); };
  SparseMatrix bad = good;
  bad.coeffRef(2, 1) = 7;
  EXPECT_NE(refused({.M = bad}).find("(3, 2) = 7"), std::string::npos) << refused({.M = bad});
  bad = good;
  bad.coeffRef(5, 5) = -1000;
  EXPECT_NE(refused({.M = bad}).find("largest at entry 6"), std::string::npos) << refused({.M = bad});
  bad.coeffRef(5, 5) = std::nan("");
  EXPECT_NE(refused({.M = bad}).find("(6, 6) = nan"), std::string::npos);
  SparseMatrix growing(good.rows(), good.rows());
  growing.insert(3, 3) = 0.5;
  const Problem fed =
      sparse_problem({.matrices = {.S = growing, .M = good}});  // taken, as in the problem custom, and without a law
  EXPECT_NE(promise_energy_law(fed, 1).reason.find("zᵀSz = 0.5"), std::string::npos)
      << promise_energy_law(fed, 1).reason;
  EXPECT_NE(refused({.S = SparseMatrix(3, 3), .M = good}).find("S is 3 × 3 but M is"), std::string::npos);
  EXPECT_NE(refused({.M = SparseMatrix(4, 6)}).find("M is 4 × 6 and must be square"), std::string::npos);
  EXPECT_EQ(refused({.M = good}), "");
}

TEST(Sparse, TheMemoryOfFactorsIsKnownWithoutStructureToo) {
  // neither a wave nor symmetric: S couples every position with the next
  const SparseMatrix M = layered_wave(60).matrices->M;
  SparseMatrix S = layered_wave(60).matrices->S;
  for (Index i = 0; i + 1 < S.rows() / 2; ++i) {
    S.coeffRef(i, i + 1) = 0.1;
    S.coeffRef(i + 1, i) = -0.1;
  }
  ASSERT_FALSE(wave_structure(S, M));
  const double expected = ResolventFactory(S, M).factor_bytes();
  Eigen::SparseMatrix<std::complex<double>> a = SparseMatrix(0.1 * (S * M)).cast<std::complex<double>>();
  a -= std::complex<double>(1, 2) * identity_matrix(S.rows()).cast<std::complex<double>>();
  a.makeCompressed();
  Eigen::SparseLU<Eigen::SparseMatrix<std::complex<double>>> lu;
  lu.compute(a);
  const double found = 20.0 * static_cast<double>(lu.nnzL() + lu.nnzU());  // a value and its row
  EXPECT_GE(expected, found / 4);
  EXPECT_LE(expected, found * 4);
}

TEST(Sparse, MergedDampingSolvesTheSameEquation) {
  Problem p = truss({.panels = 3, .mass = 2.5, .gamma = constant_rate(0.3)});
  const Problem merged = with_damping_merged(p);
  const System a = sparse(p);
  const System b = sparse(merged);
  const Vector z = Vector::Random(p.size());
  Vector x(p.size());
  Vector y(p.size());
  a.right_hand_side(0, z, x);
  b.right_hand_side(0, z, y);
  EXPECT_LE(distance(x, y), 1e-12 * largest(x));
  EXPECT_FALSE(merged.has_damping());
}

}  // namespace TEST_FILE
}  // namespace seiche::test
