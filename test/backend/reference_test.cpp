// The reference backend against formulas, and what it shares with the backends that are compared with it.
#include <test/support/cases.hpp>
#include <test/support/paths.hpp>
#include <test/support/worst.hpp>

#include <seiche/backend/dense/dense.hpp>
#include <seiche/backend/reference/reference.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/method/methods.hpp>
#include <seiche/problem/oscillator.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <complex>
#include <filesystem>
#include <fstream>
#include <regex>
#include <typeinfo>

namespace seiche::test {
namespace TEST_FILE {

// q̈ + γq̇ + ω²q = n₂ with q̇ = p + n₁, by the eigenvalues −γ/2 ± iw of L.
class DampedOscillator {
 public:
  static constexpr double omega = 2, gamma = 0.6;

  static Problem problem() {
    Problem p = oscillator({.omega_squared = omega * omega, .alpha = 0, .gamma = constant_rate(gamma)});
    p.potential = nullptr;
    return p;
  }
  // φ_k(tL) = 2 Re φ_k(tλ)(L − λ̄)/(2iw)
  static Eigen::Matrix2d phi(int k, double t) {
    using Complex = std::complex<long double>;
    const long double square_of_omega = omega * omega, g = gamma, w = std::sqrt(square_of_omega - g * g / 4);
    const Complex lambda(-g / 2, w);
    Complex sum = 0, term = 1;  // Σ_j (tλ)ʲ/(j + k)!
    for (int j = 1; j <= k; ++j) term /= static_cast<long double>(j);
    for (int j = k; j < k + 80; ++j) {
      sum += term;
      term *= static_cast<long double>(t) * lambda / static_cast<long double>(j + 1);
    }
    Eigen::Matrix<Complex, 2, 2> shifted;
    shifted << -std::conj(lambda), 1, -square_of_omega, -g - std::conj(lambda);
    return (2 * (sum / Complex(0, 2 * w) * shifted)).real().cast<double>();
  }
  static double energy(const Vector& z) { return (omega * omega * z[0] * z[0] + z[1] * z[1]) / 2; }
};

TEST(ReferenceBackend, PhiMapsOfADampedOscillatorAreThoseOfItsEigenvalues) {
  const System system = reference_system(DampedOscillator::problem());
  const auto evaluator = system.make_phi();
  const Vector z{{0.7, -0.3}}, n{{0.2, 1.1}};
  std::vector<Vector> out(1, Vector::Zero(2));
  for (const double h : {0.01, 0.4, 1.0, 4.0}) {
    for (int k = 1; k <= 4; ++k) {
      PhiRows rows{.rows = {{0.75, {0, 0, 0, 0}}}, .forces = 1, .order = 4, .kind = PhiRows::Forces::states};
      rows.rows[0].weights[static_cast<std::size_t>(k) - 1] = 1;
      evaluator->map(rows, h)->apply(z, std::vector{n}, out);
      const double t = 0.75 * h;
      const Vector expected = DampedOscillator::phi(0, t) * z + h * (DampedOscillator::phi(k, t) * n);
      EXPECT_LE(largest(out[0] - expected), 1e-15 * (1 + h)) << "h = " << h << ", k = " << k;
    }
  }
}

TEST(ReferenceBackend, PropagatorsOfAnOscillatorAreThoseOfItsEigenvalues) {
  Problem p = DampedOscillator::problem();
  p.S(1, 1) = Stencil::identity(-DampedOscillator::gamma);  // damping in S: ∂H/∂p = p
  const System system = reference_system(p);
  const Vector f{{0.2, 1.1}};
  Eigen::Matrix2d S, L;
  S << 0, 1, -1, -DampedOscillator::gamma;
  L << 0, 1, -square(DampedOscillator::omega), -DampedOscillator::gamma;
  Vector q(2);
  for (const double h : {0.01, 0.4, 1.0, 4.0}) {
    system.linear->propagator(PropagatorKind::exponential, h)->force(f, q);
    EXPECT_LE(largest(q - h * (DampedOscillator::phi(1, h) * (S * f))), 1e-15 * (1 + h)) << h;
    system.linear->propagator(PropagatorKind::cayley, h)->force(f, q);
    const Eigen::Matrix2d left = Eigen::Matrix2d::Identity() - h / 2 * L;
    EXPECT_LE(largest(left * q - h * (S * f)), 4e-15 * (1 + h)) << h;
  }
}

// γp² at the midpoint times h, less ∫γp² dt, which is what H has lost and n has done:
//   H(z) − H(x(h)) + nᵀM∫x dt,   ∫x dt = hφ₁z + h²φ₂n
TEST(ReferenceBackend, FormsOfADampedOscillatorAreTheErrorOfTheMidpointRule) {
  const System system = reference_system(DampedOscillator::problem());
  const Vector z{{0.7, -0.3}}, n{{0.2, 1.1}};
  const Vector Mn{{square(DampedOscillator::omega) * n[0], n[1]}};
  const auto phi = DampedOscillator::phi;
  const auto evaluator = system.make_phi();
  EXPECT_TRUE(evaluator->dissipation().is_quadratic && evaluator->dissipation().is_nonnegative);
  for (const double h : {0.01, 0.4, 1.0, 4.0}) {
    const std::vector<PhiEvaluator::Form> forms = {
        {{.rows = {{0.5, {0.5}}}, .forces = 1, .order = 1, .kind = PhiRows::Forces::states}, {h}, true}};
    double value = 0;
    evaluator->forms(forms, h)->apply(z, std::vector{n}, {&value, 1});
    const Vector middle = phi(0, h / 2) * z + h / 2 * (phi(1, h / 2) * n), end = phi(0, h) * z + h * (phi(1, h) * n);
    const Vector integral = h * (phi(1, h) * z) + h * h * (phi(2, h) * n);
    const double lost = DampedOscillator::energy(z) - DampedOscillator::energy(end) + Mn.dot(integral);
    EXPECT_NEAR(value, h * DampedOscillator::gamma * square(middle[1]) - lost, 4e-15 * (1 + h)) << h;
  }
}

// φ₁ is off by one part in 10⁹.
class WrongPhi final : public PhiEvaluator {
 public:
  explicit WrongPhi(std::unique_ptr<PhiEvaluator> right) : right_(std::move(right)) {}
  bool has_tables() const override { return right_->has_tables(); }
  double rate() const override { return right_->rate(); }
  std::unique_ptr<PhiMap> map(const PhiRows& rows, double h) const override {
    PhiRows wrong = rows;
    for (PhiRow& row : wrong.rows)
      for (Index j = 0; j < rows.forces; ++j) row.weights[static_cast<std::size_t>(j * rows.order)] *= 1 + 1e-9;
    return right_->map(wrong, h);
  }
  std::unique_ptr<PhiForms> forms(std::span<const Form> forms, double h) const override {
    return right_->forms(forms, h);
  }
  Dissipation dissipation() const override { return right_->dissipation(); }
  bool without_casimirs(const Vector& z, Vector& d) const override { return right_->without_casimirs(z, d); }

 private:
  std::unique_ptr<PhiEvaluator> right_;
};

Vector after_ten_time_units(const System& system) {
  const auto stepper = make_stepper(find_method("egc4"), system);
  State state{.z = system.initial};
  stepper->begin(state);
  for (int n = 0; n < 640; ++n) EXPECT_TRUE(stepper->step(state, 1.0 / 64).solved());
  return state.z;
}

// As `agreement_test` compares them.
TEST(ReferenceBackend, ComparisonsWithItSeeAWrongPhiOfTheDenseBackend) {
  const Problem problem = klein_gordon_case(0.1, 1.0);
  const Vector expected = after_ten_time_units(reference_system(problem));
  System dense = dense_system(problem);
  EXPECT_LE(largest(after_ten_time_units(dense) - expected), 1e-11);
  dense.make_phi = [right = dense.make_phi] { return std::make_unique<WrongPhi>(right()); };
  EXPECT_GT(largest(after_ten_time_units(dense) - expected), 1e-10);
}

// Else its errors would be errors of both, which no comparison sees.
TEST(ReferenceBackend, NeitherItsPartsNorTheirFunctionsAreThoseOfAnotherBackend) {
  const auto name_of = [](const auto& part) { return std::string(typeid(part).name()); };
  const auto types = [&](const System& s) {
    return std::vector<std::string>{name_of(*s.linear),
                                    name_of(*s.linear->propagator(PropagatorKind::exponential, 0.1)),
                                    name_of(*s.potential),
                                    name_of(*s.damping),
                                    name_of(*s.make_phi()),
                                    name_of(*s.make_undamped_phi())};
  };
  for (const auto& [name, problem] : all_cases()) {
    if (!problem.potential) continue;
    const std::vector<std::string> own = types(reference_system(problem)), other = types(dense_system(problem));
    for (std::size_t i = 0; i < own.size(); ++i) EXPECT_NE(own[i], other[i]) << name;
  }

  const std::regex include(R"(#include <seiche/backend/([^>]+)>)");
  std::vector<std::string> from_others;
  for (const auto& file : std::filesystem::directory_iterator(source_directory() + "/seiche/backend/reference")) {
    std::ifstream in(file.path());
    for (std::string line; std::getline(in, line);)
      if (std::smatch found; std::regex_search(line, found, include) && !found[1].str().starts_with("reference/"))
        from_others.push_back(found[1]);
  }
  EXPECT_THAT(from_others, testing::UnorderedElementsAre("dense/dense.hpp", "grid/segment.hpp"));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
