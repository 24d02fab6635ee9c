// φ-functions of eight modes at a time, where neighbouring lanes differ by many orders of magnitude and eigenvalues
// meet.
#include <test/support/matrices.hpp>
#include <test/support/plain_space.hpp>

#include <seiche/backend/modal/mode_phi.hpp>
#include <seiche/backend/phi/force_map.hpp>
#include <seiche/backend/phi/phi_functions.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace seiche::test {
namespace TEST_FILE {

// φ₀(θhL)z + h Σ_k w_k φ_{k+1}(θhL) n, by the exponential of an augmented matrix.
Vector expected_sum(const Matrix& L, const PhiRow& row, double h, const Vector& z, const Vector& n) {
  const Index m = L.rows();
  const auto p = static_cast<Index>(row.weights.size());
  Matrix augmented = Matrix::Zero(m + p, m + p);
  augmented.topLeftCorner(m, m) = row.theta * h * L;
  for (Index k = 0; k < p; ++k)
    augmented.block(0, m + p - 1 - k, m, 1) = h * row.weights[static_cast<std::size_t>(k)] * n;
  for (Index k = 0; k + 1 < p; ++k) augmented(m + k, m + k + 1) = 1;
  Vector start = Vector::Zero(m + p);
  start.head(m) = z;
  start[m + p - 1] = 1;
  return (exponential_by_extended_series(augmented) * start).head(m);
}

const PhiRows rows_of_one_force{.rows = {{0.3, {0.7, -0.2, 1.1, 0.4, 0.3}}, {1.0, {1.0, 0.5, 0.25, 0.125, -0.5}}},
                                .forces = 1,
                                .order = 5,
                                .kind = PhiRows::Forces::states};

// Where frequencies are known to ε, e^{iωh} is known to ωhε.
double tolerance(double h, const Matrix& L) { return 2e-13 + 4 * epsilon * h * L.eigenvalues().cwiseAbs().maxCoeff(); }

TEST(ModePhi, OscillatorsOfAllKindsShareAChunk) {
  struct Oscillator {
    double omega, gamma;
  };
  // critically damped, and nearly; without a restoring force; without anything; stiff; overdamped
  std::vector<Oscillator> oscillators;
  for (const double omega : {0.0, 1e-9, 1e-3, 0.45, 1.0, 7.0, 80.0}) {
    for (const double ratio : {0.0, 0.1, 2.0 * (1 - 1e-12), 2.0, 2.0 * (1 + 1e-7), 5.0})
      oscillators.push_back({omega, ratio * omega});
    oscillators.push_back({omega, 0.3});
  }
  const auto count = static_cast<Index>(oscillators.size());
  ASSERT_NE(count % 8, 0);
  ModeBlockArrays blocks(count, 2, true);
  std::vector<Matrix> matrices;
  for (Index k = 0; k < count; ++k) {
    const auto& [omega, gamma] = oscillators[static_cast<std::size_t>(k)];
    Matrix L(2, 2);
    L << 0, 1, -omega * omega, -gamma;
    matrices.push_back(L);
    for (Index i = 0; i < 2; ++i)
      for (Index j = 0; j < 2; ++j) blocks.set(k, ModeBlockArrays::L, i, j, L(i, j));
    blocks.set_size(k, scaled_norm(L));
  }
  ASSERT_TRUE(fits_lanes(blocks, rows_of_one_force, 16.0));
  const std::vector<PhiColumn> columns = {{0, 0}, {0, 1}, {1, 0}, {1, 1}};
  const Vector z = Vector::Random(2 * count);
  const Vector n = Vector::Random(2 * count);
  for (const double h : {1e-3, 0.125, 1.0, 4.0, 16.0}) {
    ModeTable table(ModeLayout::singles, count, 4, 4);
    fill_sums(blocks, rows_of_one_force, h, columns, 0, 2, table);
    Vector out = Vector::Zero(4 * count);
    const std::array in = {z.data(), z.data() + count, n.data(), n.data() + count};
    const std::array to = {out.data(), out.data() + count, out.data() + 2 * count, out.data() + 3 * count};
    table.apply(in, to, 1);
    for (Index k = 0; k < count; ++k) {
      const Matrix& L = matrices[static_cast<std::size_t>(k)];
      for (Index i = 0; i < 2; ++i) {
        const PhiRow& row = rows_of_one_force.rows[static_cast<std::size_t>(i)];
        const Vector of_z = Vector{{z[k], z[count + k]}};
        const Vector of_n = Vector{{n[k], n[count + k]}};
        const Vector expected = expected_sum(L, row, h, of_z, of_n);
        const Vector found{{out[2 * i * count + k], out[(2 * i + 1) * count + k]}};
        const double size = expected.norm() + of_z.norm() + h * of_n.norm();
        // u is as large as v/ω: each is judged in its own unit
        const double unit = 1 + std::abs(L(1, 0)) + std::abs(L(1, 1));
        EXPECT_LE(std::abs(found[0] - expected[0]), tolerance(h, L) * (1 + h) * size)
            << "ω² = " << -L(1, 0) << " h = " << h;
        EXPECT_LE(std::abs(found[1] - expected[1]), tolerance(h, L) * unit * size)
            << "ω² = " << -L(1, 0) << " h = " << h;
      }
    }
  }
}

TEST(ModePhi, ComplexFactorsTurnAndDecay) {
  constexpr Index count = 13;
  ModeBlockArrays blocks(count, 1, false);
  std::vector<std::complex<double>> lambdas;
  for (Index k = 0; k < count; ++k) {
    const double omega = k == 0 ? 0 : std::pow(3.0, static_cast<double>(k) - 6);
    lambdas.emplace_back(k % 3 == 0 ? 0.0 : -0.2 * omega, k % 2 == 0 ? omega : -omega);
    blocks.set(k, ModeBlockArrays::L, 0, 0, lambdas.back());
    blocks.set_size(k, std::abs(lambdas.back()));
  }
  const std::vector<PhiColumn> columns = {{0, 0}, {1, 0}};
  const Vector z = Vector::Random(2 * count);
  const Vector n = Vector::Random(2 * count);
  for (const double h : {1e-3, 1.0, 8.0}) {
    ModeTable table(ModeLayout::complex_pairs, count, 2, 2);
    fill_sums(blocks, rows_of_one_force, h, columns, 0, 1, table);
    Vector out = Vector::Zero(4 * count);
    const std::array in = {z.data(), n.data()};
    const std::array to = {out.data(), out.data() + 2 * count};
    table.apply(in, to, 1);
    for (Index k = 0; k < count; ++k) {
      const std::complex<double> lambda = lambdas[static_cast<std::size_t>(k)];
      Matrix L(2, 2);
      L << lambda.real(), -lambda.imag(), lambda.imag(), lambda.real();
      for (Index i = 0; i < 2; ++i) {
        const PhiRow& row = rows_of_one_force.rows[static_cast<std::size_t>(i)];
        const Vector expected = expected_sum(L, row, h, z.segment(2 * k, 2), n.segment(2 * k, 2));
        EXPECT_LE((out.segment(2 * i * count + 2 * k, 2) - expected).norm(), tolerance(h, L) * (1 + h))
            << "λ = " << lambda.real() << " + " << lambda.imag() << "i, h = " << h;
      }
    }
  }
}

// Fewer, as many and more columns than have loops of their own.
TEST(ModePhi, SumsOfAnyNumberOfColumnsAreSums) {
  for (const ModeLayout layout : {ModeLayout::singles, ModeLayout::real_pairs, ModeLayout::complex_pairs}) {
    for (const Index modes : {1, 2, 3, 4, 5, 6, 7, 8, 21}) {
      const Index slots = modes * slots_per_mode(layout);
      for (Index columns = 1; columns <= 12; ++columns) {
        const Eigen::MatrixXd in = Eigen::MatrixXd::Random(slots, columns);
        const Eigen::MatrixXcd factors = Eigen::MatrixXcd::Random(modes, columns);
        ModeTable table(layout, modes, 1, columns);
        const PlainSpace space(slots);
        ModeForms forms(layout, modes, 1, columns, space);
        std::vector<const double*> from;
        for (Index j = 0; j < columns; ++j) {
          from.push_back(in.col(j).data());
          for (Index k = 0; k < modes; ++k) {
            table.set(k, 0, j, factors(k, j));
            forms.set(k, 0, j, j, factors(k, j).real());
          }
        }
        Vector out = Vector::Constant(slots + 1, 7.0);
        const std::array to = {out.data()};
        table.apply(from, to, 1);
        std::array<double, 1> value{};
        forms.apply(from, value, 1);
        double form = 0;
        for (Index k = 0; k < modes; ++k) {
          std::complex<double> expected = 0;
          for (Index j = 0; j < columns; ++j) {
            const std::complex<double> x = layout == ModeLayout::singles
                                               ? std::complex<double>(in(k, j))
                                               : std::complex<double>(in(2 * k, j), in(2 * k + 1, j));
            expected += (layout == ModeLayout::complex_pairs ? factors(k, j) : factors(k, j).real()) * x;
            form += factors(k, j).real() * std::norm(x);
          }
          if (layout == ModeLayout::singles) {
            EXPECT_NEAR(out[k], expected.real(), 1e-14);
          } else {
            EXPECT_NEAR(out[2 * k], expected.real(), 1e-14);
            EXPECT_NEAR(out[2 * k + 1], expected.imag(), 1e-14);
          }
        }
        EXPECT_EQ(out[slots], 7.0) << "written beyond the end";
        EXPECT_NEAR(value[0], form, 1e-13 * static_cast<double>(columns * modes));
      }
    }
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
