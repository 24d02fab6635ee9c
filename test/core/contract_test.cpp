// The contract of every propagator on every backend, from which every energy law follows.
#include <test/support/cases.hpp>
#include <test/support/matrices.hpp>
#include <test/support/worst.hpp>

#include <seiche/backend/backends.hpp>
#include <seiche/core/generic_state.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <set>

namespace seiche::test {
namespace TEST_FILE {

struct Setting {
  std::string name;
  Problem problem;
  bool skew;
};

std::vector<Setting> settings() {
  std::vector<Setting> list;
  std::set<std::string> others = {"paper_FPU_2.2"};
  for (const auto& [name, problem] : gradient_flow_cases()) others.insert(name);
  for (auto& [name, problem] : all_cases()) {
    if (problem.friction || problem.has_forces()) continue;  // the S and M of another case
    const bool dissipates = problem.structure && problem.structure->dissipates();
    list.push_back({name, problem, !others.contains(name) && !dissipates});
  }
  list.push_back({"KG_whole", with_damping_merged(klein_gordon_case()), false});
  list.push_back({"FPU_whole", with_damping_merged(fpu_conservative_case()), false});
  for (auto& [name, problem] : matrix_cases()) list.push_back({name + "_whole", with_damping_merged(problem), false});
  return list;
}

// The largest entry of F + Fᵀ + FᵀMF in units of the terms: 0 for skew S.
double skew_defect(const Matrix& F, const Matrix& M) {
  const Matrix FMF = F.transpose() * M * F;
  return largest(F + F.transpose() + FMF) / (largest(F) + largest(FMF) + 1e-300);  // S = 0: nothing moves
}

template <class Check>
void for_every_propagator(const Check& check) {
  for (const Setting& setting : settings()) {
    for (const BackendEntry& backend : backends_for(setting.problem)) {
      const System system = backend.system(setting.problem, {});
      for (const PropagatorKind kind : {PropagatorKind::exponential, PropagatorKind::cayley}) {
        for (const double h : {1.0 / 64, 0.1, 1.0, 10.0}) {
          SCOPED_TRACE(fmt::format("{} {} {} h = {}", setting.name, backend.name,
                                   kind == PropagatorKind::cayley ? "cayley" : "exponential", h));
          const auto propagator = system.linear->propagator(kind, h);
          check(setting, system, *propagator, h);
        }
      }
    }
  }
}

TEST(Contract, FPlusItsAdjointPlusFMFVanishesForSkewSAndIsNegativeOtherwise) {
  for_every_propagator([](const Setting& setting, const System& system, const Propagator& propagator, double) {
    const Matrix F = matrix_of(system, [&](const Vector& x, Vector& y) { propagator.force(x, y); });
    const Matrix M = matrix_of(system, [&](const Vector& x, Vector& y) { system.linear->apply_M(x, y); });
    if (setting.skew) {
      EXPECT_LE(skew_defect(F, M), 1e-13);
    } else {
      const Matrix FMF = F.transpose() * M * F;
      const Matrix defect = F + F.transpose() + FMF;
      const double size = largest(F) + largest(FMF);
      const double largest =
          Eigen::SelfAdjointEigenSolver<Matrix>(0.5 * (defect + defect.transpose())).eigenvalues().maxCoeff();
      EXPECT_LE(largest, 1e-13 * size);
    }
  });
}

TEST(Contract, TheIncrementIsFM) {
  for_every_propagator([](const Setting&, const System& system, const Propagator& propagator, double) {
    const Matrix F = matrix_of(system, [&](const Vector& x, Vector& y) { propagator.force(x, y); });
    const Matrix M = matrix_of(system, [&](const Vector& x, Vector& y) { system.linear->apply_M(x, y); });
    const Matrix FM = matrix_of(system, [&](const Vector& x, Vector& y) { propagator.increment(x, y); });
    EXPECT_LE(largest(FM - F * M), 1e-13 * (F.cwiseAbs() * M.cwiseAbs()).maxCoeff());
  });
}

// Behind a prediction of another state too, and as often as wanted.
TEST(Contract, PowersAndUpdatesAreThoseOfIncrementAndForce) {
  for_every_propagator([](const Setting&, const System& system, const Propagator& propagator, double) {
    const auto fields = static_cast<std::size_t>(system.fields);
    const std::vector<double> before(fields, 0.75), after(fields, 0.5);
    const Space& space = *system.space;
    const Vector z = generic_state(space);
    Vector f = Vector::Zero(z.size());
    system.potential->gradient(z, f);
    Vector scratch = f, damped = 0.75 * z, dz = f, q = f;
    propagator.predict(2 * z, f, scratch, before);
    scratch = f;
    propagator.predict(z, f, scratch, before);
    const Propagator::Powers powers = propagator.powers(z, f, before);
    propagator.increment(damped, dz);
    propagator.force(f, q);
    constexpr double tolerance = 1e-12;
    const double of_f = space.norm(f);
    EXPECT_NEAR(powers.of_increment, space.dot(f, dz), tolerance * of_f * space.norm(dz));
    EXPECT_NEAR(powers.of_force, space.dot(f, q), tolerance * of_f * space.norm(q));
    EXPECT_NEAR(powers.quadratic_energy, system.linear->quadratic_energy(damped),
                tolerance * system.linear->quadratic(damped).magnitude);
    for (const double c : {0.5, -2.0}) {
      Vector found = z;
      propagator.update(found, f, c, before, after);
      const Vector expected = 0.5 * (damped + dz + c * q);
      EXPECT_LE(space.norm(found - expected), tolerance * (space.norm(damped) + space.norm(dz) + 2 * space.norm(q)));
    }
  });
}

TEST(Contract, TheExponentialPropagatorSolvesTheLinearEquation) {
  // E(h) against the dense solution of ẏ = SMy by eigenvectors in extended steps: E(h/64)^64 by an independent series.
  for (const Setting& setting : settings()) {
    for (const BackendEntry& backend : backends_for(setting.problem)) {
      const System system = backend.system(setting.problem, {});
      const Matrix A = SM_of(setting.problem);
      for (const double h : {1.0 / 64, 1.0}) {
        const auto propagator = system.linear->propagator(PropagatorKind::exponential, h);
        const Matrix E = Matrix::Identity(A.rows(), A.cols()) +
                         matrix_of(system, [&](const Vector& x, Vector& y) { propagator->increment(x, y); });
        const Matrix expected = exponential_by_extended_series(A * h);
        EXPECT_LE(largest(E - expected), 2e-13 * largest(expected))
            << setting.name << " " << backend.name << " h = " << h;
      }
    }
  }
}

TEST(Contract, PhiOneOnTheImaginaryAxisIsThatOfSineAndCosine) {
  // One oscillator, S = [[0, 1], [−1, 0]], M = ωI: hφ₁(hSM)S has entries sin(ωh)/ω and (1 − cos(ωh))/ω.
  for (const double omega : {0.0, 1e-9, 1e-4, 1.0, 30.0, 1000.0}) {
    Problem p = duffing_case(0.0);
    p.M(0, 0) = Stencil::identity(omega);
    p.M(1, 1) = Stencil::identity(omega);
    for (const BackendEntry& backend : backends()) {
      const System system = backend.system(p, {});
      const double h = 0.7;
      const auto propagator = system.linear->propagator(PropagatorKind::exponential, h);
      const Matrix F = matrix_of(system, [&](const Vector& x, Vector& y) { propagator->force(x, y); });
      const double diagonal = omega == 0 ? 0 : -2 * square(std::sin(omega * h / 2)) / omega;
      const double off = omega == 0 ? h : std::sin(omega * h) / omega;
      const double tolerance = 1e-15 * (4 + omega * h) * (omega * h > 1 ? 1 / omega : h);
      EXPECT_NEAR(F(0, 0), diagonal, tolerance) << omega << backend.name;
      EXPECT_NEAR(F(0, 1), off, tolerance) << omega << backend.name;
      EXPECT_NEAR(F(1, 0), -off, tolerance) << omega << backend.name;
    }
  }
}

TEST(Contract, TheCheckOfTheContractSeesAWrongPhi) {
  // Re φ₁ alone, a classic mistake, and φ₁ with one wrong coefficient.
  const Problem p = duffing_case(0.0);
  const Matrix S = p.S.matrix(p.grid);
  const Matrix M = p.M.matrix(p.grid);
  const double h = 0.5;
  EXPECT_GT(skew_defect(std::sin(h) * S, M), 1e-2);
  EXPECT_GT(skew_defect(h * S + h * h / 2.1 * S * M * S, M), 1e-3);
}

TEST(Contract, TheCayleyPropagatorIsCrankNicolson) {
  for (const Setting& setting : settings()) {
    const Matrix A = SM_of(setting.problem);
    const Matrix I = Matrix::Identity(A.rows(), A.cols());
    for (const BackendEntry& backend : backends_for(setting.problem)) {
      const System system = backend.system(setting.problem, {});
      for (const double h : {1.0 / 64, 0.1, 1.0, 10.0}) {
        const auto propagator = system.linear->propagator(PropagatorKind::cayley, h);
        const Matrix E = I + matrix_of(system, [&](const Vector& x, Vector& y) { propagator->increment(x, y); });
        const Matrix left = (I - h / 2 * A) * E;
        EXPECT_LE(largest(left - (I + h / 2 * A)), 1e-13 * (1 + h * largest(A)) * largest(E))
            << setting.name << backend.name << h;
      }
    }
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
