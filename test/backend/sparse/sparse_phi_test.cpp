// The trajectories behind the φ-functions of the sparse backend.
#include <test/support/cases.hpp>
#include <test/support/matrices.hpp>

#include <seiche/backend/krylov/balance.hpp>
#include <seiche/backend/phi/phi_trajectories.hpp>
#include <seiche/backend/sparse/pade.hpp>
#include <seiche/backend/sparse/sparse_kernel.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/problem/chain.hpp>
#include <seiche/problem/gkdv.hpp>
#include <seiche/problem/variable_wave.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

namespace seiche::test {
namespace TEST_FILE {

// Three rows of one trajectory and a fourth that lies on none.
PhiRows several_rows() {
  PhiRows rows{.rows = {}, .forces = 2, .order = 2, .kind = PhiRows::Forces::states};
  for (const double theta : {0.2, 1.0, 0.7})
    rows.rows.push_back({theta, {0.5 * theta, -1.5 * theta * theta, 2.0 * theta, 0.25 * theta * theta}});
  rows.rows.push_back({0.7, {1.0, 0.0, 0.0, 1.0}});
  return rows;
}

TEST(SparsePhi, RowsOfOnePolynomialAreOneTrajectory) {
  const std::vector<PhiTrajectory> trajectories = phi_trajectories(several_rows());
  ASSERT_EQ(trajectories.size(), 2u);
  EXPECT_EQ(trajectories[0].rows, (std::vector<std::size_t>{0, 2, 1}));
  EXPECT_EQ(trajectories[0].sigmas, (std::vector<double>{0.2, 0.7, 1.0}));
  EXPECT_EQ(trajectories[1].rows, (std::vector<std::size_t>{3}));
}

// Many substeps, in Krylov spaces far smaller than the systems. Frequencies ω known to ε leave e^{iωh} known to ωhε.
TEST(SparsePhiSlow, ManySubstepsAgreeWithFullMatrices) {
  const auto speed = [](const std::array<double, 3>& x) { return x[0] > 1.0 ? 2.0 : 1.0; };
  std::vector<Problem> problems = {
      variable_wave({.grid = {.points = {120}, .length = {2.0}, .boundary = {Boundary::dirichlet}},
                     .speed = speed,
                     .alpha = 1.0,
                     .gamma = constant_rate(0.1)}),
      chain({.points = 150, .ground_spring = 0.3, .neighbour_damping = 20, .gamma = constant_rate(0.05)}),
      gkdv({.points = 120, .sigma = -0.5, .mu = constant_rate(0.3)})};
  for (Problem& problem : problems) {
    for (Index i = 0; i < problem.size(); ++i) problem.initial[i] += 0.3 * std::sin(1.3 * static_cast<double>(i + 1));
    const System dense = find_backend("dense").system(problem, {});
    const System sparse = find_backend("sparse").system(problem, {});
    const auto dense_phi = dense.make_phi();
    const auto sparse_phi = sparse.make_phi();
    const PhiRows rows = several_rows();
    const std::vector<Vector> forces = {problem.initial, Vector(problem.initial.reverse())};
    const double radius = spectral_radius_bound(SM_of(problem).sparseView());
    for (const double h : {0.01, 1.0}) {
      const double tolerance = 2e-13 + 2 * epsilon * h * radius;
      std::vector<Vector> expected(4, Vector::Zero(problem.size()));
      dense_phi->map(rows, h)->apply(problem.initial, forces, expected);
      // outputs may be the forces
      std::vector<Vector> out = {forces[0], forces[1], Vector::Zero(problem.size()), Vector::Zero(problem.size())};
      sparse_phi->map(rows, h)->apply(problem.initial, std::span(out).first(2), out);
      for (std::size_t i = 0; i < out.size(); ++i)
        EXPECT_LE((out[i] - expected[i]).lpNorm<Eigen::Infinity>(), tolerance * expected[i].lpNorm<Eigen::Infinity>())
            << problem.name << " h = " << h << " row " << i;
    }
  }
}

TEST(SparsePhi, ZeroStaysZeroAndNaNStaysNaN) {
  const Problem problem = klein_gordon_case();
  const System system = find_backend("sparse").system(problem, {});
  const auto phi = system.make_phi();
  const auto map = phi->map(several_rows(), 0.1);
  std::vector<Vector> forces(2, Vector::Zero(problem.size()));
  std::vector<Vector> out(4, Vector::Ones(problem.size()));
  map->apply(Vector::Zero(problem.size()), forces, out);
  for (const Vector& v : out) EXPECT_TRUE(v.isZero(0));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    forces[1][3] = bad;
    map->apply(problem.initial, forces, out);
    for (const Vector& v : out) EXPECT_FALSE(v.allFinite());
  }
}

TEST(SparsePhi, BalancingTakesTheNormFromAStiffnessToItsFrequency) {
  const Problem problem = variable_wave({.grid = {.points = {64}, .length = {1.0}, .boundary = {Boundary::dirichlet}}});
  const Matrix L = Matrix(problem.matrices->S * problem.matrices->M);
  const Vector d = balancing_scales(SparseMatrix(L.sparseView()));
  for (const double scale : d) EXPECT_EQ(std::exp2(std::round(std::log2(scale))), scale);
  const Matrix balanced = d.cwiseInverse().asDiagonal() * L * d.asDiagonal();
  const double frequency = std::sqrt(L.cwiseAbs().rowwise().sum().maxCoeff());
  EXPECT_LE(balanced.cwiseAbs().rowwise().sum().maxCoeff(), 1.5 * frequency);
  EXPECT_GT(L.cwiseAbs().rowwise().sum().maxCoeff(), 50 * frequency);
}

TEST(SparsePhi, KernelsAreFoundInPermutationsDifferencesAndEmptyRows) {
  SparseMatrix permutation(3, 3);
  permutation.insert(0, 1) = 2;
  permutation.insert(1, 2) = -1;
  permutation.insert(2, 0) = 1e-9;
  EXPECT_EQ(sparse_kernel(permutation).cols(), 0);

  SparseMatrix empty_row(3, 3);  // and column
  empty_row.insert(0, 1) = 1;
  empty_row.insert(1, 0) = -1;
  const Matrix unit = sparse_kernel(empty_row);
  ASSERT_EQ(unit.cols(), 1);
  EXPECT_NEAR(std::abs(unit(2, 0)), 1, 1e-15);

  const Problem even = gkdv({.points = 40});  // central differences see neither a constant nor (−1)ʲ
  const SparseMatrix S = even.S.sparse_matrix(even.grid);
  const Matrix kernel = sparse_kernel(S);
  ASSERT_EQ(kernel.cols(), 2);
  EXPECT_LE((kernel.transpose() * kernel - Matrix::Identity(2, 2)).norm(), 1e-14);
  EXPECT_LE((S * kernel).norm(), 1e-13 * S.norm());
}

TEST(SparsePhi, KernelsAreFoundInLargeRingsToo) {
  for (const Index points : {20000, 20001}) {  // an odd ring knows no (−1)ʲ
    const Problem ring = gkdv({.length = 1000.0, .points = points});
    const SparseMatrix S = ring.S.sparse_matrix(ring.grid);
    const Matrix kernel = sparse_kernel(S);
    ASSERT_EQ(kernel.cols(), points % 2 == 0 ? 2 : 1);
    EXPECT_LE((kernel.transpose() * kernel - Matrix::Identity(kernel.cols(), kernel.cols())).norm(), 1e-13);
    EXPECT_LE((S * kernel).norm(), 1e-13 * S.norm());
    const Vector constant = Vector::Constant(points, 1 / std::sqrt(static_cast<double>(points)));
    EXPECT_NEAR((kernel.transpose() * constant).norm(), 1, 1e-12);
  }
  SparseMatrix everything(qr_limit + 1, qr_limit + 1);  // more than is looked for
  everything.insert(0, 1) = 1;
  EXPECT_EQ(sparse_kernel(everything).cols(), 0);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
