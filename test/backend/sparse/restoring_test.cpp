// Propagators by linear solvers that hold to a tolerance only.
#include <seiche/backend/backends.hpp>
#include <seiche/backend/sparse/pade_propagator.hpp>
#include <seiche/problem/truss.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace seiche::test {
namespace TEST_FILE {

// Resolvents with an error of 1e-8 of their result.
class InexactResolvents final : public Resolvents {
 public:
  explicit InexactResolvents(const Resolvents& exact) : exact_(exact) {}
  std::unique_ptr<Resolvent> make(double h, std::complex<double> pole) const override {
    class Inexact final : public Resolvent {
     public:
      explicit Inexact(std::unique_ptr<Resolvent> exact) : exact_(std::move(exact)) {}
      void apply(const Vector& b, Vector& x) const override {
        exact_->apply(b, x);
        const double size = 1e-8 * x.norm() / std::sqrt(static_cast<double>(x.size()));
        for (double& value : x)
          value += size * (2 * static_cast<double>(random_()) / static_cast<double>(random_.max()) - 1);
      }

     private:
      std::unique_ptr<Resolvent> exact_;
      mutable std::mt19937_64 random_{5};
    };
    return std::make_unique<Inexact>(exact_.make(h, pole));
  }

 private:
  const Resolvents& exact_;
};

struct Setting {
  Setting() {
    for (Vector* v : {&z, &f, &g}) {
      v->resize(M.rows());
      for (double& value : *v) value = static_cast<double>(random() % 2001) / 1000 - 1;
    }
  }
  std::unique_ptr<Propagator> propagator(bool restores, PropagatorKind kind, double h) {
    const auto force = [&](double length) {
      const PadePlan plan = kind == PropagatorKind::cayley ? PadePlan{1, 1} : PadePlan{6, 1};
      return std::make_unique<PadeForce>(S_times, M_times, M.rows(), inexact, length, plan);
    };
    auto half = kind == PropagatorKind::cayley ? nullptr : force(h / 2);
    if (!restores) return pade_propagator(M_times, *system.space, support, force(h), std::move(half));
    return restoring_pade_propagator(M_times, *system.space, support, force(h), std::move(half), moved);
  }

  // 2wᵀy + yᵀMy for y = Fw, against the sizes of its terms.
  double miss(const Vector& w, const Vector& y) const {
    const Vector My = M * y;
    return std::abs(2 * w.dot(y) + y.dot(My)) / (2 * w.norm() * y.norm() + y.norm() * My.norm());
  }

  Problem problem = truss({});
  SparseMatrix S = problem.matrices->S, M = problem.matrices->M;
  System system = find_backend("sparse").system(problem, {});
  Potential::Support support = system.potential->support();
  SparseProduct<const SparseMatrix&> S_times{S}, M_times{M};
  ResolventFactory exact{S, M};
  InexactResolvents inexact{exact};
  std::mt19937_64 random{11};
  Vector z, f, g;
  double moved = 0;
};

// Of every sum of Mz, f and g, as closures take them: after an increment the forces that follow it.
double worst_miss(const Setting& s, const Propagator& F) {
  Vector dz(s.z.size()), q(s.z.size()), r(s.z.size());
  F.increment(s.z, dz);
  F.force(s.f, q);
  F.force(s.g, r);
  double worst = 0;
  for (const auto& [b, c] : std::array<std::pair<double, double>, 4>{{{0, 0}, {1, 0}, {-0.7, 0.4}, {0.2, -3}}})
    worst = std::max(worst, s.miss(s.M * s.z + b * s.f + c * s.g, dz + b * q + c * r));
  return worst;
}

TEST(RestoringPropagator, HoldsItsContractToRoundOffWhereTheSolverDoesNot) {
  for (const PropagatorKind kind : {PropagatorKind::exponential, PropagatorKind::cayley}) {
    for (const double h : {0.01, 0.3}) {
      Setting s;
      EXPECT_GT(worst_miss(s, *s.propagator(false, kind, h)), 1e-11);
      EXPECT_EQ(s.moved, 0);
      EXPECT_LT(worst_miss(s, *s.propagator(true, kind, h)), 1e-14);
      EXPECT_GT(s.moved, 1e-11);
      EXPECT_LT(s.moved, 1e-5);
    }
  }
}

// ½z⁺ᵀMz⁺ − ½zᵀMz = −c fᵀ(z⁺ − z), the identity under the law of sav.
TEST(RestoringPropagator, UpdatesByWhatItsPowersSay) {
  for (const bool restores : {false, true}) {
    Setting s;
    const auto F = s.propagator(restores, PropagatorKind::exponential, 0.1);
    Vector f = Vector::Zero(s.z.size());
    f.segment(s.support.begin, s.support.size) = s.f.segment(s.support.begin, s.support.size);
    const Propagator::Powers powers = F->powers(s.z, f, {});
    Vector z = s.z;
    const double c = 0.8;
    F->update(z, f, c, {}, {});
    const double gained = z.dot(s.M * z) / 2 - powers.quadratic_energy;
    const double given = -c * (powers.of_increment + c * powers.of_force);
    const double miss = std::abs(gained - given) / powers.quadratic_energy;
    if (restores)
      EXPECT_LT(miss, 1e-14);
    else
      EXPECT_GT(miss, 1e-12);
  }
}

TEST(RestoringPropagator, LeavesAStateAtRestAndNoForceAlone) {
  Setting s;
  const auto F = s.propagator(true, PropagatorKind::exponential, 0.1);
  const Vector zero = Vector::Zero(s.z.size());
  Vector dz = zero, q = zero;
  F->increment(zero, dz);
  F->force(zero, q);
  EXPECT_EQ(dz, zero);
  EXPECT_EQ(q, zero);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
