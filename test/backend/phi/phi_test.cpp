// Sums of φ-functions against the exponential of an augmented matrix in extended precision.
#include <test/support/cases.hpp>
#include <test/support/matrices.hpp>
#include <test/support/worst.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <tuple>

namespace seiche::test {
namespace TEST_FILE {

Matrix L_of(const Problem& p) {
  const Matrix D0 = p.matrices ? Matrix(constant_damping_matrix(p)) : constant_damping(p).matrix(p.grid);
  return SM_of(p) - D0;
}

Matrix S_of(const Problem& p) { return p.matrices ? Matrix(p.matrices->S) : p.S.matrix(p.grid); }

// φ₀(A)z + Σ_k φ_{k+1}(A) c_k, the first part of the exponential of [[A, c], [0, shift]] applied to (z, e_last).
Vector phi_sum(const Matrix& A, const Vector& z, const Matrix& c) {
  const Index n = A.rows();
  const Index p = c.cols();
  Matrix augmented = Matrix::Zero(n + p, n + p);
  augmented.topLeftCorner(n, n) = A;
  for (Index k = 0; k < p; ++k) augmented.block(0, n + p - 1 - k, n, 1) = c.col(k);
  for (Index k = 0; k + 1 < p; ++k) augmented(n + k, n + k + 1) = 1;
  Vector start = Vector::Zero(n + p);
  start.head(n) = z;
  start[n + p - 1] = 1;
  return (exponential_by_extended_series(augmented) * start).head(n);
}

TEST(PhiSlow, SumsOfEveryBackendAreThoseOfTheDefinition) {
  for (const auto& [name, problem] : all_cases()) {
    if (problem.friction || problem.has_forces()) continue;  // the L of another case
    const Matrix L = L_of(problem);
    const Matrix S = S_of(problem);
    std::map<std::tuple<double, bool, std::size_t>, Vector> sums;  // by h, the kind of forces, and the row
    for (const BackendEntry& backend : backends_for(problem)) {
      const System system = backend.system(problem, {});
      const auto phi = system.make_phi();
      const Vector z = system.initial;
      Vector gradient = Vector::Zero(z.size());
      system.potential->gradient(z, gradient);
      Vector other = gradient;
      const auto support = system.potential->support();
      other.segment(support.begin, support.size) += 0.3 * z.segment(support.begin, support.size);
      for (const double h : {1.0 / 64, 0.5, 4.0}) {
        for (const PhiRows::Forces kind : {PhiRows::Forces::gradients, PhiRows::Forces::states}) {
          PhiRows rows{.rows = {}, .forces = 2, .order = 3, .kind = kind};
          rows.rows = {{0.3, {0.7, -0.2, 1.1, 0.4, 2.0, -1.0}}, {1.0, {1.0, 0.0, 0.0, 0.5, 0.25, 0.125}}};
          const bool gradients = kind == PhiRows::Forces::gradients;
          const std::vector<Vector> forces = {gradients ? gradient : z, other};
          std::vector<Vector> out(2, Vector::Zero(z.size()));
          phi->map(rows, h)->apply(z, forces, out);
          for (std::size_t i = 0; i < 2; ++i) {
            Matrix c = Matrix::Zero(L.rows(), 3);
            for (Index j = 0; j < 2; ++j) {
              const Vector f = system.space->physical(forces[static_cast<std::size_t>(j)]);
              const Vector n = gradients ? Vector(S * f) : f;
              for (Index k = 0; k < 3; ++k)
                c.col(k) += h * rows.rows[i].weights[static_cast<std::size_t>(3 * j + k)] * n;
            }
            const double theta = rows.rows[i].theta;
            Vector& expected = sums[{h, gradients, i}];
            if (expected.size() == 0) expected = phi_sum(theta * h * L, system.space->physical(z), c);
            const double size = largest(expected) + largest(c);
            EXPECT_LE(largest(system.space->physical(out[i]) - expected), 2e-13 * size)
                << name << " " << backend.name << " h = " << h << " row " << i
                << (gradients ? " gradients" : " states");
          }
        }
      }
    }
  }
}

// Q of the forms against ∇HᵀDz − ∇HᵀS∇H without V, along the same dense output.
TEST(Phi, FormsAreTheDissipationOfTheirRows) {
  int compared = 0;
  for (const auto& [name, problem] : all_cases()) {
    for (const BackendEntry& backend : backends_for(problem)) {
      const System system = backend.system(problem, {});
      if (!system.damping->is_constant()) continue;
      const auto phi = system.make_phi();
      if (!phi->dissipation().is_quadratic || phi->dissipation().is_zero) continue;
      const Vector z = system.initial;
      std::vector<Vector> forces(1, Vector::Zero(z.size()));
      system.potential->gradient(z, forces[0]);
      PhiRows rows{.rows = {{0.4, {0.4}}, {1.0, {1.0}}}, .forces = 1, .order = 1};
      const double h = 0.25;
      const std::vector<PhiEvaluator::Form> forms = {{rows, {0.3, 0.7}}, {rows, {1.0, 0.0}}};
      std::vector<double> values(2);
      phi->forms(forms, h)->apply(z, forces, values);

      std::vector<Vector> out(2, Vector::Zero(z.size()));
      phi->map(rows, h)->apply(z, forces, out);
      Vector scratch(z.size());
      Vector gradient_H(z.size());
      const Vector none = Vector::Zero(z.size());
      std::vector<double> Q;
      for (const Vector& v : out) {
        const System::Dissipation q = system.dissipation(0, v, none, scratch, gradient_H);
        Q.push_back(q.rate + q.work);  // by damping alone
      }
      const double size = std::abs(Q[0]) + std::abs(Q[1]) + 1e-300;
      EXPECT_NEAR(values[0], 0.3 * Q[0] + 0.7 * Q[1], 1e-12 * size) << name << " " << backend.name;
      EXPECT_NEAR(values[1], Q[0], 1e-12 * size) << name << " " << backend.name;
      ++compared;
    }
  }
  EXPECT_GE(compared, 20);
}

TEST(Phi, CasimirsAreTheKernelOfSAndNothingElse) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const auto& [name, problem] : all_cases()) {
    const Matrix S = S_of(problem);
    for (const BackendEntry& backend : backends_for(problem)) {
      const System system = backend.system(problem, {});
      Vector d = Vector::Zero(system.initial.size());
      Vector z = Vector::Zero(d.size());
      Vector values(problem.size());
      for (double& x : values) x = uniform(random);
      system.space->from_physical(values, z);
      const Eigen::FullPivLU<Matrix> lu = Eigen::FullPivLU<Matrix>(S).setThreshold(1e-12);
      const bool has_casimirs = system.make_phi()->without_casimirs(z, d);
      ASSERT_EQ(has_casimirs, lu.dimensionOfKernel() > 0) << name << " " << backend.name;
      if (!has_casimirs) continue;
      const Vector removed = system.space->physical(z) - system.space->physical(d);
      EXPECT_LE((S * removed).norm(), 1e-12 * S.norm()) << name;
      EXPECT_LE((lu.kernel().transpose() * system.space->physical(d)).norm(), 2e-12 * lu.kernel().norm() * d.norm())
          << name;
    }
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
