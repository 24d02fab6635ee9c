// Parts of ensembles by themselves: transforms folded along their mirrors, potentials of many members, and statistics
// over them.
#include <seiche/core/panel_potential.hpp>
#include <seiche/ensemble/folded_transform.hpp>
#include <seiche/ensemble/statistics.hpp>
#include <seiche/potential/bond.hpp>
#include <seiche/potential/cosine.hpp>
#include <seiche/potential/nodal.hpp>
#include <seiche/potential/polynomials.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <typeinfo>
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

using Potentials = std::vector<std::shared_ptr<const PointwisePotential>>;

// Of `panel` at the values u, and of its means from u to b, against what each member says alone; relative.
void expect_members(const Potentials& members, PanelPotential& panel, Index rows, double tolerance) {
  Panel u(rows), b(rows), slopes(rows), means(rows);
  for (Index j = 0; j < rows; ++j)
    for (Index l = 0; l < panel_members; ++l) {
      u(j, l) = std::sin(static_cast<double>(3 * j + 7 * l));
      b(j, l) = u(j, l) + 0.1 * static_cast<double>(l);
    }
  PanelValues values{}, again{}, sizes{};
  panel.value_and_gradient(u.row(0), slopes.row(0), values);
  panel.value_and_magnitude(u.row(0), again, sizes);
  panel.begin_means(u.row(0));
  panel.mean_gradient(b.row(0), means.row(0));
  Panel v(rows), w(rows);  // in place
  std::copy_n(u.row(0), rows * panel_members, v.row(0));
  std::copy_n(b.row(0), rows * panel_members, w.row(0));
  PanelValues in_place{};
  panel.value_and_gradient(v.row(0), v.row(0), in_place);
  panel.mean_gradient(w.row(0), w.row(0));
  for (Index l = 0; l < panel_members; ++l) {
    const auto member = static_cast<std::size_t>(l);
    const PointwisePotential& V = *members[member];
    std::vector<double> of_u, of_b, mean(static_cast<std::size_t>(rows));
    for (Index j = 0; j < rows; ++j) {
      of_u.push_back(u(j, l));
      of_b.push_back(b(j, l));
    }
    std::vector<double> gradient = of_u;
    const double value = V.value_and_gradient_in_place(1, 1, gradient);
    const ValueAndMagnitude both = V.value_and_magnitude(of_u);
    V.mean_gradient(of_u, of_b, mean);
    EXPECT_NEAR(values[member], value, tolerance * both.magnitude);
    EXPECT_EQ(in_place[member], values[member]);
    EXPECT_NEAR(again[member], both.value, tolerance * both.magnitude);
    EXPECT_NEAR(sizes[member], both.magnitude, tolerance * both.magnitude);
    for (Index j = 0; j < rows; ++j) {
      const auto at = static_cast<std::size_t>(j);
      EXPECT_NEAR(slopes(j, l), gradient[at], 10 * tolerance) << rows << " " << j << " " << l;
      EXPECT_NEAR(means(j, l), mean[at], 10 * tolerance) << rows << " " << j << " " << l;
      EXPECT_EQ(v(j, l), slopes(j, l));
      EXPECT_EQ(w(j, l), means(j, l));
    }
  }
}

std::shared_ptr<const PointwisePotential> some_potential(Index l) {
  const double alpha = 0.5 - 0.1 * static_cast<double>(l);
  if (l % 4 == 0) return std::make_shared<NodalPotential<Cosine>>(Cosine{alpha});
  const Polynomial<4> w{{0, 0, alpha, 0.3, 1}};
  if (l % 4 == 1) return std::make_shared<NodalPotential<Polynomial<4>>>(w);
  constexpr std::array ends = {Boundary::periodic, Boundary::dirichlet, Boundary::neumann};
  return std::make_shared<BondPotential<Polynomial<4>>>(w, ends[static_cast<std::size_t>(l) % ends.size()]);
}

TEST(PanelPotential, OfAnyPotentialsIsToTheBitThatOfEachMember) {
  Potentials members;
  for (Index l = 0; l < panel_members; ++l) members.push_back(some_potential(l));
  for (const Index rows : {1, 3, 4, 20, 77}) {
    const std::unique_ptr<PanelPotential> panel = members[1]->for_members(members, rows);
    expect_members(members, *panel, rows, 0);
  }
}

TEST(PanelPotential, OfCosinesHasTheFactorOfEachMember) {
  Potentials members;
  for (Index l = 0; l < panel_members; ++l)
    members.push_back(std::make_shared<NodalPotential<Cosine>>(Cosine{0.5 - 0.1 * static_cast<double>(l)}));
  for (const Index rows : {1, 20, 77}) {
    const std::unique_ptr<PanelPotential> panel = members[0]->for_members(members, rows);
    EXPECT_NE(dynamic_cast<CosinePanel*>(panel.get()), nullptr);
    expect_members(members, *panel, rows, 1e-14);
  }
}

TEST(PanelPotential, OfPolynomialsHasTheCoefficientsOfEachMember) {
  for (int degree = 1; degree <= max_polynomial_degree; ++degree) {
    Potentials members;
    for (Index l = 0; l < panel_members; ++l) {
      std::vector<double> c;
      for (int i = 0; i <= degree; ++i) c.push_back((0.75 - 0.1 * i) / (1 + static_cast<double>(l)));
      members.push_back(nodal_polynomial(c));
    }
    constexpr Index rows = 11;
    const std::unique_ptr<PanelPotential> panel = members[0]->for_members(members, rows);
    const std::unique_ptr<PanelPotential> any = member_by_member(members, rows);
    const PanelPotential &of_polynomials = *panel, &of_any = *any;
    EXPECT_NE(typeid(of_polynomials), typeid(of_any));
    expect_members(members, *panel, rows, 4e-15 * degree);
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
