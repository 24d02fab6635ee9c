// Parts of ensembles by themselves: transforms folded along their mirrors, and statistics over members.
#include <seiche/ensemble/folded_transform.hpp>
#include <seiche/ensemble/statistics.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

using Matrix = Eigen::MatrixXd;

Matrix fourier(Index n) {
  Matrix T(n, n);
  Index row = 0;
  for (Index k = 0; 2 * k <= n; ++k) {
    const bool alone = k == 0 || 2 * k == n;
    for (const bool sine : {false, true}) {
      if (sine && alone) continue;
      for (Index j = 0; j < n; ++j) {
        const double phase = 2 * std::numbers::pi * static_cast<double>(k * (j + 1) % n) / static_cast<double>(n);
        T(row, j) =
            std::sqrt((alone ? 1.0 : 2.0) / static_cast<double>(n)) * (sine ? std::sin(phase) : std::cos(phase));
      }
      ++row;
    }
  }
  return T;
}

Matrix sines(Index n) {
  Matrix T(n, n);
  for (Index k = 0; k < n; ++k)
    for (Index j = 0; j < n; ++j)
      T(k, j) = std::sqrt(2.0 / static_cast<double>(n + 1)) *
                std::sin(std::numbers::pi * static_cast<double>((k + 1) * (j + 1)) / static_cast<double>(n + 1));
  return T;
}

void expect_transform(const Matrix& T, const std::string& name) {
  const FoldedTransform folded(T);
  const Index n = T.rows();
  Panel values(n), coordinates(n), back(n);
  Matrix given(n, panel_members);
  for (Index j = 0; j < n; ++j)
    for (Index l = 0; l < panel_members; ++l)
      given(j, l) = values(j, l) = std::sin(static_cast<double>(j * panel_members + l));
  folded.forward(values.row(0), coordinates.row(0));
  folded.inverse(coordinates.row(0), back.row(0));
  const Matrix expected = T * given;
  for (Index j = 0; j < n; ++j) {
    for (Index l = 0; l < panel_members; ++l) {
      EXPECT_NEAR(coordinates(j, l), expected(j, l), 1e-13) << name << " " << n;
      EXPECT_NEAR(back(j, l), given(j, l), 1e-13) << name << " " << n;
    }
  }
}

TEST(FoldedTransform, IsTheMatrixItWasMadeFrom) {
  for (const Index n : {1, 2, 3, 5, 8, 15, 20, 32}) {
    expect_transform(fourier(n), "Fourier");
    expect_transform(sines(n), "sines");
    expect_transform(Matrix::Identity(n, n), "identity");
    expect_transform(Eigen::HouseholderQR<Matrix>(sines(n) + 0.1 * Matrix::Ones(n, n)).householderQ(), "no mirror");
  }
}

TEST(Statistics, AreTheTextbookOnes) {
  std::vector<double> values = {4, 1, 3, 2, 10};
  const Statistics s = statistics(values);
  EXPECT_DOUBLE_EQ(s.mean, 4);
  EXPECT_DOUBLE_EQ(s.standard_deviation, std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(s.minimum, 1);
  EXPECT_DOUBLE_EQ(s.median, 3);
  EXPECT_DOUBLE_EQ(s.maximum, 10);
  EXPECT_DOUBLE_EQ(s.low, 1.2);
  EXPECT_DOUBLE_EQ(s.high, 8.8);
  std::vector<double> one = {7};
  EXPECT_DOUBLE_EQ(statistics(one).standard_deviation, 0);
  EXPECT_DOUBLE_EQ(statistics(one).high, 7);
  EXPECT_TRUE(std::isnan(statistics({}).mean));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
