// Noise balances what dissipates: identities between B and the flows of every backend, without a random number.
#include <test/support/cases.hpp>
#include <test/support/error_of.hpp>

#include <seiche/backend/backends.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/noise/bath.hpp>
#include <seiche/problem/alpha_fpu.hpp>
#include <seiche/problem/chain.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace seiche::test {
namespace TEST_FILE {

using Matrix = Eigen::MatrixXd;
using testing::HasSubstr;

// The matrix of a map of states, in physical coordinates.
Matrix matrix_of(const Space& space, const std::function<void(const Vector& in, Vector& out)>& map) {
  const Index n = space.physical_size();
  Matrix all(n, n);
  Vector unit(n), column(n), in = Vector::Zero(space.size()), out(space.size());
  for (Index j = 0; j < n; ++j) {
    unit = Vector::Unit(n, j);
    space.from_physical(unit, in);
    map(in, out);
    space.to_physical(out, column);
    all.col(j) = column;
  }
  return all;
}

struct Pieces {
  Matrix E, M, covariance;  // a flow, the metric, and BBᵀ
};

Pieces pieces(const System& system, double h, const std::function<void(const Vector& in, Vector& out)>& flow) {
  const Space& space = *system.space;
  const std::unique_ptr<LinearMap> B = system.make_noise(h);
  const Matrix b = matrix_of(space, [&](const Vector& in, Vector& out) { B->apply(in, out); });
  return {.E = matrix_of(space, flow),
          .M = matrix_of(space, [&](const Vector& in, Vector& out) { system.linear->apply_M(in, out); }),
          .covariance = b * b.transpose()};
}

constexpr double step_sizes[] = {1e-4, 0.1, 3.0, 100.0};

// The covariance C = M⁻¹ of exp(−zᵀMz/2) is kept: what is tested is multiplied by M from both sides, where M has no
// inverse.
TEST(Noise, OfAKickBeforeAndBehindTheExactLinearFlowKeepsGibbsMeasure) {
  for (const NamedProblem& c : gradient_flow_cases()) {
    if (c.problem.size() > 300) continue;
    for (const BackendEntry& backend : quick_backends_for(c.problem)) {
      const System system = backend.system(c.problem, {});
      for (const double h : step_sizes) {
        if (h > 10 && backend.name == "sparse") continue;  // Padé approximation of the highest degree is not e^{hL}
        const std::unique_ptr<Propagator> flow = system.linear->propagator(PropagatorKind::exponential, h);
        const Pieces p = pieces(system, h, [&](const Vector& in, Vector& out) {
          flow->increment(in, out);
          out += in;
        });
        // E(M⁻¹ + Q)Eᵀ + Q = M⁻¹, with EM⁻¹ = M⁻¹Eᵀ.
        const Matrix left = p.M * (p.E * p.covariance * p.E.transpose() + p.covariance) * p.M;
        const Matrix right = p.M - p.M * p.E * p.E;
        EXPECT_LE((left - right).norm(), 1e-8 * (1 + p.M.norm())) << c.name << ' ' << backend.name << ' ' << h;
      }
    }
  }
}

std::vector<NamedProblem> coupled_dampings() {
  std::vector<NamedProblem> all;
  all.push_back({"dashpots between masses", chain({.points = 12, .mass = 0.7, .neighbour_damping = 0.4})});
  all.push_back(
      {"and to the ground",
       chain({.points = 9, .boundary = Boundary::periodic, .neighbour_damping = 0.4, .gamma = constant_rate(0.3)})});
  all.push_back({"alpha_fpu", fpu_conservative_case()});
  return all;
}

TEST(Noise, OfADampingThatCouplesPointsIsThatOfOrnsteinAndUhlenbeck) {
  for (const NamedProblem& c : coupled_dampings()) {
    for (const BackendEntry& backend : quick_backends_for(c.problem)) {
      const System system = backend.system(c.problem, {});
      const Index n = c.problem.size() / 2;
      for (const double h : step_sizes) {
        const Pieces p = pieces(system, h, [&](const Vector& in, Vector& out) {
          out = in;
          system.damping->flow(0, h, out);
        });
        const Matrix variance = p.M.bottomRightCorner(n, n).inverse(), E = p.E.bottomRightCorner(n, n);
        const Matrix kept = E * variance * E.transpose() + p.covariance.bottomRightCorner(n, n);
        EXPECT_LE((kept - variance).norm(), 1e-9 * variance.norm()) << c.name << ' ' << backend.name << ' ' << h;
        EXPECT_EQ(p.covariance.topRows(n).norm(), 0) << "coordinates do not jump";
      }
    }
  }
}

TEST(Noise, IsRefusedWhereNoneBalancesWhatDissipates) {
  const auto refusal = [](const Problem& problem, double temperature = 0.1) {
    return error_of([&] {
      System system = find_backend("dense").system(problem, {});
      Bath(system, problem, {.temperature = temperature});
    });
  };
  EXPECT_THAT(refusal(duffing_case(0.1), -1), HasSubstr("the temperature -1 of noise must be ≥ 0"));
  EXPECT_THAT(refusal(klein_gordon_case(0)), HasSubstr("needs what dissipates"));
  EXPECT_THAT(refusal(gkdv_case()), HasSubstr("moves what V depends on"));
  for (const NamedProblem& c : beyond_linear_cases()) {
    if (!c.problem.friction && !c.problem.structure) continue;
    EXPECT_THAT(refusal(c.problem), HasSubstr(c.problem.friction ? "has the friction" : "one matrix S")) << c.name;
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
