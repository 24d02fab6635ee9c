#include <seiche/method/closure/newton_krylov.hpp>
#include <test/support/plain_space.hpp>

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <random>

namespace seiche {
namespace TEST_FILE {

using test::PlainSpace;

Eigen::MatrixXd random_matrix(Index n, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Eigen::MatrixXd A(n, n);
  for (double& x : A.reshaped()) x = normal(random);
  return A;
}

TEST(Gmres, SolvesWhatAFactorisationSolves) {
  std::mt19937_64 random(7);
  for (const Index n : {1, 5, 40}) {
    const Eigen::MatrixXd A = random_matrix(n, random) + 4 * Eigen::MatrixXd::Identity(n, n);
    const Vector b = random_matrix(n, random).col(0);
    const auto apply = [&](const Vector& w, Vector& out) { out = A * w; };
    const Vector x = gmres(PlainSpace(n), apply, b, static_cast<int>(n), 1e-13);
    EXPECT_LE((x - A.partialPivLu().solve(b)).norm(), 1e-10 * x.norm()) << n;
  }
}

TEST(Gmres, StopsWhereTheToleranceIsMetAndWhereTheSpaceHoldsTheSolution) {
  std::mt19937_64 random(8);
  constexpr Index n = 50;
  const Eigen::MatrixXd A = 0.02 * random_matrix(n, random) + Eigen::MatrixXd::Identity(n, n);
  const Vector b = random_matrix(n, random).col(0);
  int products = 0;
  const auto apply = [&](const Vector& w, Vector& out) {
    ++products;
    out = A * w;
  };
  const Vector x = gmres(PlainSpace(n), apply, b, 50, 1e-3);
  EXPECT_LE((b - A * x).norm(), 1e-3 * b.norm());
  EXPECT_LT(products, 10);

  products = 0;
  const auto scaled = [&](const Vector& w, Vector& out) {
    ++products;
    out = 3 * w;
  };
  EXPECT_LE((3 * gmres(PlainSpace(n), scaled, b, 50, 1e-12) - b).norm(), 1e-14 * b.norm());
  EXPECT_EQ(products, 1);
  EXPECT_EQ(gmres(PlainSpace(n), apply, Vector::Zero(n), 50, 1e-12).norm(), 0.0);
}

// Nilpotent, so that no vector of the space comes nearer to b.
TEST(Gmres, GivesTheBestThereIsWhereTheMapIsSingular) {
  const Vector b{{1, 2, 3}};
  const auto nothing = [](const Vector& w, Vector& out) { out = 0 * w; };
  EXPECT_EQ(gmres(PlainSpace(3), nothing, b, 3, 1e-12).norm(), 0.0);
  const auto shift = [](const Vector& w, Vector& out) { out = Vector{{w[1], w[2], 0}}; };
  const Vector x = gmres(PlainSpace(3), shift, Vector{{1, 1, 0}}, 3, 1e-12);
  EXPECT_TRUE(x.allFinite());
}

}  // namespace TEST_FILE
}  // namespace seiche
